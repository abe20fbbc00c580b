#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# The paper's bodies, its half-circular plates from their files among them: Fig. 2 in one command.
. "$(dirname "$0")/../support/lib.sh"

# the catalogue lies elsewhere: the plates ship with the program
start_daemon

say "a plate of 20 mm gives back all but a thousandth, one of 10 mm a hundredth less"
expect 0 percuss query --a steel-sphere --b al-half-plate --speed 0.3 --json
# another program's finite elements: .9994 within .0005
awk -v e="$(field restitution)" 'BEGIN { exit !(e > 0.9989 && e < 0.9999) }' || fail "e is $(field restitution)"

say "Fig. 2"
expect 0 percuss sweep --a steel-sphere --b al-cylinder --b al-half-plate --b al-half-plate-10 --b al-rod \
    --b al-beam --speed 0.1:0.5:5 --csv --plot "$work/figure.svg"
grep -q al-half-plate-10 "$work/figure.svg" || fail "no plate in the picture"
# compact, plate and rod fall steadily, the rod most; the beam has no pattern
awk -F, 'NR > 1 { if ($1 != "al-beam" && b == $1 && $4 > e + 2e-4) bad = 1
        if ($1 == "al-beam" && b == $1 && $4 > e) rises = 1; b = $1; e = $4; last[b] = e }
    END { exit bad || !rises || !(last["al-cylinder"] > last["al-half-plate-10"]) ||
        !(last["al-half-plate-10"] > last["al-rod"]) }' "$out" || fail "$(cat "$out")"

stop_daemon
