#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A newcomer follows the tutorial, command by command.
. "$(dirname "$0")/../support/lib.sh"
. "$source_dir/tests/documents.sh"
page=$source_dir/docs/tutorial.md
mkdir "$work/bench"
cd "$work/bench"

# the daemon is waited for where it is started
runnable "$page" | in_domain "$domain" |
    sed -e "s|^build/bin/|$bin/|" -e '/&$/s|$|\nsleep 1|' >"$work/script"
[ "$(grep -c "^$bin/percuss" "$work/script")" -ge 10 ] || fail "not all commands are found"

say "every command of the page"
expect 0 follow <"$work/script"
[ ! -s "$err" ] || ! grep -v '^[0-9-]*T' "$err" || fail "warnings"

say "what it says comes of them"
shows "ok"
transcript "$page" "query --local --catalogue bench.yaml --a ball" | head -n 4 | while read -r line; do
    # to four digits: another compiler may differ in the last ones
    shows "$(echo "$line" | sed 's/\(restitution *[0-9.]\{6\}\).*/\1/')"
done
shows "sub-impacts          equal in 5 of 5 impacts"
shows "yield of ball"
[ "$(grep -c '^[0-9]' sweep.csv)" -eq 9 ] || fail "the sweep has no nine rows"
for file in sweep.svg impact.svg; do
    grep -q '<svg' "$file" || fail "$file is no picture"
done
