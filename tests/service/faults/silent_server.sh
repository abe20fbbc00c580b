#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What a client says of a server that does not answer, or goes while it is waited for.
. "$(dirname "$0")/../support/lib.sh"

# start_silent MODE, stop_silent: a server that answers nobody
start_silent() {
    : >"$work/silent"
    "$peers/wire_silent" "$domain" "$1" >"$work/silent" 2>&1 9>&- &
    others=$!
    wait_for 20 grep -q there "$work/silent" || fail "$(cat "$work/silent")"
}
stop_silent() {
    kill -KILL $others
    wait $others 2>/dev/null || true
    others=
}

# longer than the two seconds after which what does not fit is a verdict
say "one that is there and does not answer is named, and its partition is no verdict"
start_silent announced
expect 4 query --timeout 3
says "percussd 5e5e5e5e (process $others on here) is there but has not answered for 3."
says "s (busy?)"
say "status shows what it announces"
expect 4 percuss status --timeout 1
shows "server      5e5e5e5e5e5e5e5e5e5e5e5e5e5e5e5e"
says "has not answered"
say "beside one that answers it harms nobody"
start_daemon
# sooner or later: a client does not wait until it has found everybody
warns() {
    expect 0 query
    grep -q "percussd 5e5e5e5e (process $others on here) answers here too, with ANOTHER CATALOGUE" "$err"
}
wait_for 20 warns || fail "no warning"
expect 4 query --server 5e --timeout 1
says "percussd 5e5e5e5e"
stop_daemon
stop_silent

say "one that has not announced itself may be anybody"
start_silent anonymous
expect 3 query --timeout 3
says "no percussd has answered in DDS domain $domain, where somebody reads requests"
stop_silent

say "what does not fit is named"
start_silent unreliable
expect 3 query --timeout 3
says "a server is there, but its replies do not match ours: reliability (policy 11)"
stop_silent

say "a program's calls name the server that has gone, and ask no other one before it connects again"
start_daemon
mkfifo "$work/acts"
"$peers/lost_client" "$domain" <"$work/acts" >"$work/told" 2>&1 9>&- &
others=$!
exec 8>"$work/acts"
wait_for 40 grep -q "act 1 is over" "$work/told" || fail "$(cat "$work/told")"
first=$daemon
stop_daemon
echo >&8
wait_for 40 grep -q "act 2 is over" "$work/told" || fail "$(cat "$work/told")"
start_daemon
echo >&8
wait_for 40 grep -q "act 3 is over" "$work/told" || fail "$(cat "$work/told")"
exec 8>&-
wait "$others" || fail "the client failed"
others=
for call in solve batch ping bodies; do
    # before it went, and after the second connect; gone, and gone with another one there
    [ "$(grep -c "^$call: ok$" "$work/told")" = 2 ] || fail "$call: $(cat "$work/told")"
    [ "$(grep -c "^$call: no server: percussd [0-9a-f]\{8\} (process $first on .*) is gone; connect" "$work/told")" = 2 ] ||
        fail "$call: $(cat "$work/told")"
done
grep -q "^servers: no server: no percussd has announced itself" "$work/told" || fail "$(cat "$work/told")"
stop_daemon

# ensemble_runs: the daemon computes one
ensemble_runs() {
    percuss status --json >"$out" 2>"$err" && [ -n "$(field activity)" ]
}

say "a server that is killed is missed long before the time is over"
settings "workers: 1"
start_daemon
"$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam --speed uniform:0.1:0.4 \
    --samples 2000000 --timeout 600 >"$work/ensemble" 2>"$work/lost" 9>&- &
others=$!
wait_for 40 ensemble_runs || fail "no ensemble runs"
kill -KILL "$daemon"
wait "$daemon" 2>/dev/null || true
daemon=
wait_for 60 is_gone "$others" || fail "it still waits after 60 s: $(cat "$work/lost")"
code=0
wait "$others" || code=$?
others=
cp "$work/lost" "$err"
[ "$code" -eq 3 ] || fail "exit code $code, not 3"
grep -q '^percuss: percussd [0-9a-f]\{8\} (process [0-9]* on .*) is gone; connect again' "$err" ||
    fail "it does not say who is gone"
