#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A daemon is killed and another one takes its place.
. "$(dirname "$0")/../support/lib.sh"

start_daemon
expect 0 query --json
cp "$out" "$work/first"

say "killed, it is missed"
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
expect 3 query --timeout 1

say "its successor gives the same numbers under another name"
start_daemon
expect 0 query --json
[ "$(field server)" != "$(field server "$work/first")" ] || fail "the server has the same id"
numbers "$work/first" | sed '/"server":/d' >"$work/a"
numbers "$out" | sed '/"server":/d' >"$work/b"
cmp -s "$work/a" "$work/b" || fail "other numbers: $(diff "$work/a" "$work/b")"

say "a client that was killed does no harm"
"$peers/wire_clients" "$domain" >"$work/clients" 2>&1 9>&- &
others=$!
sleep 0.3
kill -KILL "$others" 2>/dev/null || true
wait "$others" 2>/dev/null || true
others=
expect 0 query
expect 0 "$peers/wire_clients" "$domain"

say "nor does one that is stopped with its replies unread"
"$peers/wire_clients" "$domain" >"$work/clients" 2>&1 9>&- &
others=$!
sleep 0.3
kill -STOP "$others" 2>/dev/null || true
for i in 1 2 3; do
    expect 0 query
done
stop_daemon
