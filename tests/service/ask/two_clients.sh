#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Two clients at once get their own answers, each the same as alone.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
for speed in 0.2 0.3; do
    expect 0 percuss query --a steel-sphere --b al-beam --speed "$speed" --json
    numbers "$out" >"$work/alone-$speed"
done

say "ten times two clients side by side"
for i in 1 2 3 4 5 6 7 8 9 10; do
    others=
    for speed in 0.2 0.3; do
        percuss query --a steel-sphere --b al-beam --speed "$speed" --json \
            >"$work/both-$speed" 2>"$err" 9>&- &
        others="$others $!"
    done
    for client in $others; do
        wait "$client" || fail "a client ended with $?"
    done
    others=
    for speed in 0.2 0.3; do
        numbers "$work/both-$speed" >"$work/b"
        cmp -s "$work/alone-$speed" "$work/b" ||
            fail "other numbers: $(diff "$work/alone-$speed" "$work/b")"
    done
done
stop_daemon
