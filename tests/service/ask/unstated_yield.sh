#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Metals whose yield is not stated: the answer says above which yield it holds, and its error is that of an
# ordinary metal, whatever it is asked with.
. "$(dirname "$0")/../support/lib.sh"

cat >"$work/catalogue.yaml" <<'YAML'
materials:
  steel: {young: 210 GPa, poisson: 0.30, density: 7800}
  brass: {young: 105 GPa, poisson: 0.34, density: 8500}
  firm:  {young: 210 GPa, poisson: 0.30, density: 7800, yield: 2 GPa}
  ideal: {young: 210 GPa, poisson: 0.30, density: 7800, yield: none}
bodies:
  ball:  {shape: sphere, material: steel, radius: 15 mm}
  wall:  {shape: half-space, material: steel}
  bead:  {shape: sphere, material: brass, radius: 10 mm}
  shot:  {shape: sphere, material: firm, radius: 15 mm}
  anvil: {shape: half-space, material: firm}
  idol:  {shape: sphere, material: ideal, radius: 15 mm}
  stage: {shape: half-space, material: ideal}
YAML
told="contacts[0]: no yield (or none) is stated of steel (ball): the answer holds for metals that yield above"
settings "workers: 2"

# once TEXT FILE: in exactly one line
once() {
    [ "$(grep -cF -- "$1" "$2")" -eq 1 ] || fail "'$1' in $(grep -cF -- "$1" "$2") lines, not one"
}

say "--check-config names metals that state neither a yield nor none"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --check-config
once "percussd: materials.steel.yield: not stated: " "$err"
once "percussd: materials.brass.yield: not stated: " "$err"
[ "$(wc -l <"$err")" -eq 2 ] || fail "others"

say "so does percuss bodies --check, which finds nothing improbable in that"
start_daemon
expect 0 percuss bodies --check
once "materials.steel.yield: not stated: " "$out"
once "materials.brass.yield: not stated: " "$out"
[ "$(wc -l <"$out")" -eq 3 ] || fail "others"
expect 0 percuss bodies
grep -q "^idol .*no yield" "$out" || fail "none is not listed"
! grep -q "^ball .*no yield" "$out" || fail "nothing is stated of steel"

say "beyond what any steel bears the error holds the strongest"
expect 0 percuss query --a shot --b anvil --speed 4.43 --json
with=$(field restitution)
expect 0 percuss query --a ball --b wall --speed 4.43 --json
once "$told 4023 MPa, which hardly any does (young/100: 2100 MPa)" "$out"
[ ! -s "$err" ] || fail "twice"
[ "$(field total_met)" = false ] || fail "the total error is said to be within the tolerance"
awk -v a="$(field restitution)" -v b="$with" -v e="$(field restitution_model)" \
    'BEGIN { exit !(a > 0.99 && b < 0.92 && a - b < e) }' || fail "the error of $(field restitution) does not hold $with"
awk -v t="$(field restitution_total)" -v y="$(field restitution_yield)" \
    'BEGIN { exit !(t > 0.08 && t - y > 0 && t - y < 0.002) }' || fail "the error without a yield"
expect 0 percuss query --a ball --b wall --speed 4.43
says "$told 4023 MPa"
shows "holds for metals that yield above 4023 MPa"
shows "if metals whose yield is not stated stay elastic"

say "yield: none is as elastic, and silent"
elastic=$(percuss query --a ball --b wall --speed 4.43 --json 2>/dev/null | grep -m 1 '"restitution"')
expect 0 percuss query --a idol --b stage --speed 4.43 --json
[ "$(grep -m 1 '"restitution"' "$out")" = "$elastic" ] || fail "another restitution"
! grep -q "no yield\|yield above" "$out" || fail "told"
awk -v e="$(field restitution_yield)" 'BEGIN { exit !(e == 0) }' || fail "the error of a yield"
awk -v e="$(field restitution_model)" 'BEGIN { exit !(e < 0.001) }' || fail "the models' error"

say "the same in process"
expect 0 "$bin/percuss" query --local --catalogue "$work/catalogue.yaml" --a ball --b wall --speed 4.43
says "$told 4023 MPa"

say "a sweep, an ensemble and a comparison count it"
expect 0 percuss sweep --a ball --b wall --speed 1.5:4:3
once "points: 3 of 3, first at 1.5 m/s: $told" "$err"
expect 0 percuss sweep --a ball --b wall --speed 1.5:4:3 --json
sed -n '/^  "warnings": \[/,/^  \]/p' "$out" >"$work/list"
once "points: 3 of 3, first at 1.5 m/s: $told" "$work/list"
expect 0 percuss ensemble --a bead --b wall --speed uniform:0.1:0.5 --samples 100
once "samples: 100 of 100, first 0: contacts[0]: no yield (or none) is stated of brass (bead)" "$err"
printf 'speed,restitution\n0.2,0.9\n0.3,0.88\n0.4,0.85\n0.5,0.84\n' >"$work/rig.csv"
expect 0 percuss compare "$work/rig.csv" --a ball --b anvil
once "contacts[0]: no yield (or none) is stated of steel (ball)" "$err"

say "an override of the yield says it too"
cat >"$work/request.json" <<'JSON'
{"bodies": [{"id": "ball", "position": [0, 0, 0.015], "velocity": [0, 0, -4.43], "overrides": {"yield": 2e9}},
            {"id": "wall", "overrides": {"yield": 2e9}}],
 "contacts": [{"a": 0, "b": 1, "point": [0, 0, 0], "normal": [0, 0, 1]}]}
JSON
expect 0 percuss query --request "$work/request.json" --json
! grep -q "is stated of" "$out" || fail "told"
stop_daemon
