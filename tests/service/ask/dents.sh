#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Contacts yield, dents stay in the states of bodies and harden.
. "$(dirname "$0")/../support/lib.sh"

start_daemon

# less A B: whether A < B
less() {
    awk -v a="$1" -v b="$2" 'BEGIN { exit !(a < b) }'
}

say "the paper's rod 1 loses energy to its dent"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model closed-form --json
[ "$(field contact_model)" = closed-form ] || fail "model $(field contact_model)"
first=$(field restitution)
less 0.47 "$first" && less "$first" 0.50 || fail "e = $first"
less 0 "$(field plastic)" || fail "no plastic energy"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3
grep -q 'closed-form' "$out" && grep -q 'dent' "$out" || fail "the table does not name the model"

say "auto takes the same, and Hertz where nothing yields"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --json
[ "$(field contact_model)" = closed-form ] || fail "model $(field contact_model)"
[ "$(field restitution)" = "$first" ] || fail "auto differs"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.005 --json
[ "$(field contact_model)" = hertz ] || fail "model $(field contact_model)"

say "Hertz by force, with a warning"
expect 0 percuss query --a steel-sphere --b al-rod-1 --speed 0.3 --contact-model hertz --json
[ "$(field contact_model)" = hertz ] || fail "model $(field contact_model)"
grep -q 'yield stress of al-rod-1' "$out" || fail "no warning"

say "the next blow into the dent gives more back"
strike() { # strike STATE OPTIONS
    cat >"$work/request.json" <<JSON
{"bodies": [{"id": "steel-sphere", "position": [0.515, 0, 0], "velocity": [-0.3, 0, 0]},
            {"id": "al-rod-1", $1 "position": [0, 0, 0]}],
 "contacts": [{"a": 0, "b": 1, "point": [0.5, 0, 0], "normal": [1, 0, 0]}],
 "options": {$2}}
JSON
    expect 0 percuss query --request "$work/request.json" --json
}
strike "" ""
# the contact's place is rounded otherwise
awk -v a="$(field restitution)" -v b="$first" 'BEGIN { exit !((a - b) ^ 2 < 1e-18) }' ||
    fail "as a request: $(field restitution), not $first"
token=$(sed -n 's/^ *"state": "\([0-9a-f]\{32\}\)"$/\1/p' "$out")
[ -n "$token" ] || fail "no state"
# the rod rings on: with and without the dent it does so alike
strike "\"state\": \"$token\", \"elapsed\": 1.0," ""
second=$(field restitution)
grep -q 'dent of earlier impacts' "$out" || fail "the dent is not felt: $second"
strike "\"state\": \"$token\", \"elapsed\": 1.0," '"dents": "ignore"'
grep -q 'dent of earlier impacts' "$out" && fail "the dent is not ignored"
less "$(field restitution)" "$second" || fail "the dent does not harden"
stop_daemon
