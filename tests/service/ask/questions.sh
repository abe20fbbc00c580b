#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Questions are answered; the same question has the same numbers.
. "$(dirname "$0")/../support/lib.sh"

start_daemon

say "one contact at the default sites"
expect 0 query --json
[ "$(field status)" = OK ] || fail "status $(field status)"
[ "$(field complete)" = true ] || fail "not complete"
cp "$out" "$work/first"

say "the same numbers again, from the reading thread and from workers"
for i in 1 2 3; do
    expect 0 query --json
    numbers "$work/first" >"$work/a"
    numbers "$out" >"$work/b"
    cmp -s "$work/a" "$work/b" || fail "other numbers: $(diff "$work/a" "$work/b")"
done

say "the same question as a whole request"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0.025], "orientation": [1, 0, 0, 0],
             "velocity": [0, 0, -0.3], "angular_velocity": [0, 0, 0]},
            {"id": "al-beam", "position": [0, 0, 0]}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0.010], "normal": [0, 0, 1]}]}
JSON
expect 0 percuss query --request "$work/request.json" --json
restitution=$(field restitution)
impulse=$(field impulse)
expect 0 percuss query --request - --json <"$work/request.json"
[ "$(field restitution)" = "$restitution" ] && [ "$(field impulse)" = "$impulse" ] ||
    fail "a request on standard input has other numbers"

say "a group: its impulses have errors of their own"
cat >"$work/group.json" <<'JSON'
{"bodies": [{"id": "steel-sphere", "position": [0, 0, 0], "velocity": [0.3, 0, 0]},
            {"id": "steel-sphere", "position": [0.03, 0, 0]}, {"id": "steel-sphere", "position": [0.06, 0, 0]}],
 "contacts": [{"a": 0, "b": 1, "point": [0.015, 0, 0], "normal": [-1, 0, 0]},
              {"a": 1, "b": 2, "point": [0.045, 0, 0], "normal": [-1, 0, 0]}]}
JSON
expect 0 percuss query --request "$work/group.json"
[ "$(grep -c '^  impulse  .* N s +- [0-9.e-]*  (' "$out")" = 2 ] || fail "impulses without errors: $(cat "$out")"

say "a rod, and a state that goes on ringing"
expect 0 percuss query --a steel-sphere --b al-rod --speed 0.3 --json
token=$(sed -n 's/^ *"state": "\([0-9a-f]\{32\}\)"$/\1/p' "$work/first")
[ -n "$token" ] || fail "the beam has no state afterwards"
sed 's/"al-beam",/"al-beam", "state": "'"$token"'", "elapsed": 0.01,/' "$work/request.json" \
    >"$work/ringing.json"
percuss query --request "$work/ringing.json" --json >"$out" 2>"$err" || [ $? -eq 1 ] ||
    fail "the state is not accepted"
[ "$(field impulse)" != "$impulse" ] || fail "the state changes nothing"
stop_daemon
