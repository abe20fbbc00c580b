#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Clients on the types of 0.1.0 ask the daemon of today, and clients of today a server of 0.1.0: members that came
# since are left out by one and ignored by the other. tests/upgrade.sh does so with the programs of then.
. "$(dirname "$0")/../support/lib.sh"

say "clients of then: eight at once, replays, refusals, states and batches"
start_daemon
for client in clients replays refusals exchanges; do
    expect 0 "$peers/old_$client" "$domain"
done
stop_daemon

say "their replies are those of clients of today, to the last bit"
settings "store: dents.db"
start_daemon
expect 0 "$peers/old_specimens" "$domain" old-plate 3 "$work/old"
stop_daemon
settings "store: others.db"
start_daemon
expect 0 "$peers/wire_specimens" "$domain" new-plate 3 "$work/new"
cut -d ' ' -f 1,2 "$work/old" >"$work/old-numbers"
cut -d ' ' -f 1,2 "$work/new" | cmp -s - "$work/old-numbers" || fail "other numbers"
stop_daemon

say "a server of then: a client of today finds it, names it, and reads its answers"
"$peers/old_server" "$domain" >"$out" 2>"$err" 9>&- &
others=$!
wait_for 10 grep -q there "$out" || fail "no server"
expect 0 percuss ping
expect 0 percuss status
shows "percussd 0.1.0"
cat >"$work/request.json" <<JSON
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]}, {"id": "al-beam"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}]}
JSON
expect 0 percuss query --request "$work/request.json" --json
[ "$(field restitution)" = 0.625 ] || fail "another restitution"
[ "$(field restitution_time)" = 0.00029999999999999997 ] || fail "another error"
expect 0 percuss query --request "$work/request.json" --server 5e5e
shows "restitution  0.625"
