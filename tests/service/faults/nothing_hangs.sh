#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Nothing hangs and everything can be stopped: hard requests hold up nobody, deadlines and departures end
# them, and so does the end of the daemon.
. "$(dirname "$0")/../support/lib.sh"

settings "workers: 2" "drain_seconds: 1" "store: specimens.db"
start_daemon

say "pings are answered while a hard request is solved"
expect 0 "$peers/wire_bounds" "$domain" pings
cat "$out"

say "new clients connect while one hard request follows the other"
"$peers/wire_bounds" "$domain" hammer >"$work/blows" 2>"$work/hammer" 9>&- &
others=$!
connected=0
while ! is_gone "$others"; do
    expect 0 percuss ping
    connected=$((connected + 1))
done
wait "$others" || fail "$(cat "$work/hammer")"
others=
echo "$connected new clients, $(cat "$work/blows") hard requests"
# each of them joins, is found and asks: behind solves these are three waits, and a third as many clients; on
# its own a client takes about as long as a hard request, so that as many may come or one less
[ $((2 * connected)) -ge "$(cat "$work/blows")" ] || fail "only $connected new clients"

say "a deadline ends every method and the members of a batch"
expect 0 "$peers/wire_bounds" "$domain" deadlines
cat "$out"

say "a deadline ends an ensemble whose single impacts outlast it"
expect 4 timeout 40 "$bin/percuss" ensemble --domain "$domain" --a steel-sphere --b al-beam \
    --speed uniform:0.1:0.3 --method cvode --tolerance 1e-8 --samples 100 --deadline 1 --json
[ "$(field status)" = TIMEOUT ] || fail "status $(field status)"

say "a deadline leaves nothing of an impact in the store"
cat >"$work/request.json" <<EOF
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]},
            {"id": "al-beam", "specimen": "bar-1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}],
 "options": {"method": "cvode", "tolerance": 1e-9, "deadline": 0.5}}
EOF
expect 4 percuss query --request "$work/request.json" --json
[ "$(field status)" = TIMEOUT ] || fail "status $(field status)"
expect 5 percuss dents --specimen bar-1

say "work for a client that has left is given up"
expect 0 "$peers/wire_bounds" "$domain" leave
cat "$out"

say "what is being solved when the time to drain is over is refused, and the daemon ends well"
"$peers/wire_bounds" "$domain" wait >"$work/asked" 2>&1 9>&- &
others=$!
wait_for 20 grep -q asked "$work/asked" || fail "$(cat "$work/asked")"
sleep 1
stop_daemon
wait "$others" || fail "$(cat "$work/asked")"
others=
