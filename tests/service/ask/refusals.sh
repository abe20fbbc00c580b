#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# What cannot be answered is refused with a reason, and the daemon goes on.
. "$(dirname "$0")/../support/lib.sh"

start_daemon

say "an unknown body"
expect 5 percuss query --a steel-sphere --b no-such-body --speed 0.3
says "no-such-body"

say "a state nobody has given out"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "velocity": [0, 0, -0.3]},
            {"id": "al-beam", "state": "0123456789abcdef0123456789abcdef"}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}]}
JSON
expect 5 percuss query --request "$work/request.json"
says "bodies[1].state"

say "a normal that is no unit vector"
sed -e 's/, "state": "[0-9a-f]*"//' -e 's/"normal": \[0, 0, 1\]/"normal": [0, 0, 2]/' \
    "$work/request.json" >"$work/normal.json"
expect 5 percuss query --request "$work/normal.json"
says "must be a unit vector"

say "a specimen where there is no store"
sed -e 's/"state": "[0-9a-f]*"/"specimen": "bar-1"/' "$work/request.json" >"$work/specimen.json"
expect 5 percuss query --request "$work/specimen.json"
says "bodies[1].specimen: bar-1: must be empty: this server keeps no specimens"

say "bad requests of every kind, straight on the wire"
expect 0 "$peers/wire_refusals" "$domain"
cat "$out"
expect 0 query
expect 0 percuss status
logged "error" && fail "refusals are no errors of the daemon"
stop_daemon
