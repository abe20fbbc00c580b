#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# A client's id is its own while it is there; names that would be paths or commands are names; and
# somebody who sends rubbish does not fill the log.
. "$(dirname "$0")/../support/lib.sh"

settings "store: $work/store.db" "tables: $work"
start_daemon

say "requests with the id of another client"
expect 0 "$peers/wire_owner" "$domain"
wait_for 5 logged 'warning 10 requests bore the id of another client: ignored' || fail "the log does not tell"

# ls of everything that a request might have made
everything() {
    find "$work" -name 'touched*' -o -name '*.db*' | sort
}

say "names that shells, gnuplot and SQL would obey"
cd "$work"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b plain
everything >"$work/before"
# what they mean is for others to expand
# shellcheck disable=SC2016
for name in '../touched' '/tmp/touched' '$(touch touched)' '`touch touched`' "'; system('touch touched'); '" \
    '"; system("touch touched"); "' "x'; DROP TABLE specimens; --" '|touch touched'; do
    for field in --a --specimen-b --at-b --server; do
        code=0
        "$bin/percuss" query --domain "$domain" --a steel-sphere --b al-rod-1 --speed 0.3 "$field" "$name" \
            --plot "$work/picture.svg" >"$out" 2>"$err" 9>&- || code=$?
        [ "$code" -le 5 ] || fail "exit code $code: $field $name"
    done
    # as good a name as any
    expect 0 percuss dents --specimen "$name" --clear
done
lines="a
system('touch touched')"
expect 5 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --specimen-b "$lines" --plot picture.svg
says "must be UTF-8 without control characters"
everything >"$work/after"
cmp "$work/before" "$work/after" || fail "a file has come: $(diff "$work/before" "$work/after")"
expect 0 percuss dents --specimen plain

say "a thousand damaged packets and more leave a few lines"
before=$(wc -l <"$log")
timeout 20 "$peers/wire_damaged" requests "$domain" 1000 >"$out" 2>&1 9>&- || true
expect 0 percuss ping
lines=$(($(wc -l <"$log") - before))
logged 'DDS: ' || fail "nothing of it is in the log"
[ "$lines" -le 40 ] || fail "$lines lines of log"
stop_daemon
