#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Plastics and rubber lose energy of themselves: it is in the number, also of groups of contacts, and who asks for another law is
# told that it is not, and how much that is, whatever he asks with.
. "$(dirname "$0")/../support/lib.sh"

cat >"$work/catalogue.yaml" <<'YAML'
materials:
  steel:  {young: 210 GPa, poisson: 0.30, density: 7800}
  nylon:  {young: 3 GPa, poisson: 0.40, density: 1140, loss_factor: 0.06}
  rubber: {young: 5 MPa, poisson: 0.49, density: 1100}
  ideal:  {young: 5 MPa, poisson: 0.49, density: 1100, loss_factor: 0}
  pom:    {young: 4 GPa, poisson: 0.40, density: 1410, relaxation: [{share: 0.1, time: 30 us}, {share: 0.1, time: 0.3 ms}]}
  felt:   {young: 5 MPa, poisson: 0.3, density: 3000}
  slow:   {young: 3 GPa, poisson: 0.40, density: 1140, loss_factor: 0.06, loss_frequency: 1 Hz}
  near:   {young: 3 GPa, poisson: 0.40, density: 1140, loss_factor: 0.06, loss_frequency: 1.5 kHz}
bodies:
  ball:   {shape: sphere, material: steel, radius: 15 mm}
  bead:   {shape: sphere, material: nylon, radius: 15 mm}
  stop:   {shape: half-space, material: nylon}
  slow:   {shape: half-space, material: slow}
  near:   {shape: half-space, material: near}
  mat:    {shape: half-space, material: rubber}
  spring: {shape: half-space, material: ideal}
  bar:    {shape: rod, material: nylon, radius: 10 mm, length: 1}
  pad:    {shape: half-space, material: pom}
  bell:   {shape: rod, material: nylon, radius: 10 mm, length: 1, damping: 0}
  felt:   {shape: sphere, material: felt, radius: 15 mm}
  post:   {shape: block, material: nylon, size: [200 mm, 40 mm, 60 mm], ends: cantilever}
laws:
  buffer: {between: [steel, felt], points: press.csv, unloading: release.csv}
  damper: {between: [rubber, nylon], stiffness: 2e6, dissipation: 0.3}
friction:
- {between: [steel, felt], coefficient: 0.3, deviation: 0.05}
YAML
printf 'm,N\n0,0\n2e-4,1.5\n5e-4,7\n1e-3,20\n2e-3,56\n' >"$work/press.csv"
printf '2e-3,56\n1.5e-3,20\n1e-3,4\n5e-4,0\n' >"$work/release.csv"
lost="of itself in the contact (loss_factor 0.06) is not in the answer: the restitution is lower by about 0.0"
settings "workers: 2"
start_daemon

# once TEXT FILE: in exactly one line
once() {
    [ "$(grep -cF -- "$1" "$2")" -eq 1 ] || fail "'$1' in $(grep -cF -- "$1" "$2") lines, not one"
}

say "who lists the bodies sees it"
expect 0 percuss bodies
grep "^bead .*loss factor 0.06" "$out" >/dev/null || fail "not listed"
! grep "^ball .*loss factor" "$out" >/dev/null || fail "steel's is not stated"

say "and the pairs of materials with their laws and friction"
grep "^felt  *steel  *0.3 +- 0.05  *buffer: 5 points of press.csv to 0.002 m and 56 N, unloading by release.csv to 0.0005 m, deviation 0.05$" \
    "$out" >/dev/null || fail "felt on steel"
grep "^nylon  *rubber  *damper: 2e+06 N/m^1.5, dissipation 0.3 s/m, deviation 0.05$" "$out" >/dev/null || fail "nylon on rubber"
cp "$out" "$work/table"
expect 0 percuss bodies --pairs
sed -n '/^material /,$p' "$work/table" | cmp - "$out" || fail "the pairs alone are others"
expect 0 percuss bodies --pairs --csv
grep -q '^felt,steel,0.2[0-9]*,0.05[0-9]*,buffer,points,nan,nan,nan,nan,0.05[0-9]*,press.csv,5,0.002[0-9]*,56,release.csv,0.0005[0-9]*$' "$out" ||
    fail "CSV: $(cat "$out")"
expect 2 percuss bodies --pairs --json
expect 0 percuss bodies --csv
grep -q '^pad,.*,nan,0.1[0-9]* 3.0*[0-9]*e-05; 0.1[0-9]* 0.000[0-9]*,nan,nan,nan$' "$out" || fail "what relaxes: $(grep ^pad "$out")"
expect 0 percuss bodies --json
cp "$out" "$work/bodies.json"
expect 0 "$bin/percuss" bodies --local --catalogue "$work/catalogue.yaml" --json
cmp "$work/bodies.json" "$out" || fail "in process it is another list"
[ "$(grep -c '"material_a"' "$out")" -eq 2 ] || fail "pairs in JSON: $(grep -c '"material_a"' "$out")"

say "a material that relaxes loses by its series, and is as stiff as at the impact's frequency"
grep "^pad .*modulus relaxes to 0.8 of young, by 2 of its times" "$work/table" >/dev/null || fail "not listed"
expect 0 percuss query --a ball --b pad --speed 0.3 --json
[ "$(field contact_model)" = viscoelastic ] || fail "$(field contact_model)"
awk -v e="$(field restitution)" 'BEGIN { exit !(e > 0.88 && e < 0.96) }' || fail "e = $(field restitution)"
expect 0 percuss query --a ball --b pad --speed 0.3 --contact-model hertz
says "contacts[0]: what pad loses of itself in the contact (loss_factor 0.0"

say "a stated loss is in the answer, and in its error"
expect 0 percuss query --a ball --b stop --speed 0.3 --json
[ "$(field contact_model)" = viscoelastic ] || fail "$(field contact_model)"
! grep -q "of itself" "$out" || fail "told"
awk -v e="$(field restitution)" 'BEGIN { exit !(e > 0.88 && e < 0.95) }' || fail "e = $(field restitution)"
straight=$(field restitution)
model=$(field restitution_model)
awk -v e="$model" 'BEGIN { exit !(e > 0.02 && e < 0.05) }' || fail "the models' error"

say "as far as its frequency is from the contact's: the same answer with another error, and who sees the bodies sees it"
expect 0 percuss query --a ball --b near --speed 0.3 --json
[ "$(field restitution)" = "$straight" ] && [ "$(field restitution_model)" = "$model" ] || fail "$(field restitution)"
! grep -q "was measured at" "$out" || fail "told"
expect 0 percuss query --a ball --b slow --speed 0.3 --json
[ "$(field restitution)" = "$straight" ] || fail "$(field restitution), not $straight"
awk -v e="$(field restitution_model)" -v m="$model" 'BEGIN { exit !(e > 1.5 * m && e < 0.08) }' || fail "$(field restitution_model)"
once "contacts[0]: the loss_factor of slow (0.06) was measured at 1 Hz, and this contact has 94" "$out"
grep "^slow .*loss factor 0.06 at 1 Hz" "$work/table" >/dev/null || fail "not listed"
grep -q '"loss_frequency": 1.0*,\?$' "$work/bodies.json" || fail "not in JSON"

say "friction leaves the loss in the number: plain, and micro-slip, whose surface springs back"
same() {
    [ "$(field contact_model)" = viscoelastic ] || fail "$(field contact_model)"
    ! grep -q "of itself" "$out" || fail "told"
    awk -v e="$(field restitution)" -v s="$straight" 'BEGIN { exit !((e - s)^2 < 1e-6) }' || fail "e = $(field restitution), $straight"
}
expect 0 percuss query --a ball --b stop --speed 0.3 --spin 200 --friction 0.2 --friction-law plain --json
same
expect 0 percuss query --a ball --b stop --speed 0.3 --spin 20 --friction 0.2 --friction-law plain --json
same
awk -v t="$(field tangential_restitution)" 'BEGIN { exit !(t^2 < 1e-6) }' || fail "sticks: $(field tangential_restitution)"
expect 0 percuss query --a ball --b stop --speed 0.3 --spin 20 --friction 0.2 --json
same
awk -v t="$(field tangential_restitution)" 'BEGIN { exit !(t > 0.1) }' || fail "springs back: $(field tangential_restitution)"
expect 0 percuss query --a ball --b stop --speed 0.3 --friction 0.2 --json
same
[ "$(field friction_state)" = stuck ] || fail "$(field friction_state)"
say "by cvode it has not, and says so"
expect 0 percuss query --a ball --b stop --speed 0.3 --spin 200 --friction 0.2 --method cvode
says "$lost"
says "the tolerance is 0.001; method modal has it, or options.friction none"
expect 5 percuss query --a ball --b stop --speed 0.3 --spin 200 --friction 0.2 --method cvode --contact-model viscoelastic
says "options.contact_model: viscoelastic: method cvode has no friction beside it"

say "left out, it is told with its size, and so is one that nobody stated"
expect 0 percuss query --a ball --b stop --speed 0.3 --contact-model hertz
says "contacts[0]: what stop loses $lost"
says "; the tolerance is 0.001"
expect 0 percuss query --a ball --b mat --speed 0.3
says "contacts[0]: materials as soft as that of mat (young 5 MPa) lose energy of themselves"
says "as it has no loss_factor; state one"
expect 0 percuss query --a ball --b spring --speed 0.3
! grep -q "energy of themselves\|of itself" "$err" || fail "0 is a statement"

say "a tolerance that is wider than that has nothing to be told"
expect 0 percuss query --a ball --b stop --speed 0.3 --contact-model hertz --tolerance 0.2
! grep -q "of itself" "$err" || fail "told"

say "it is in the error that the answer states"
expect 0 percuss query --a ball --b stop --speed 0.3 --contact-model hertz --json
once "contacts[0]: what stop loses $lost" "$out"
[ ! -s "$err" ] || fail "twice"
[ "$(field total_met)" = false ] || fail "the total error is said to be within the tolerance"
awk -v e="$(field restitution_model)" 'BEGIN { exit !(e > 0.07 && e < 0.12) }' || fail "the models' error"

say "the same in process"
expect 0 "$bin/percuss" query --local --catalogue "$work/catalogue.yaml" --a ball --b stop --speed 0.3 \
    --contact-model hertz
says "contacts[0]: what stop loses $lost"

say "a law of the catalogue has its own loss, and says so"
expect 0 percuss query --a ball --b felt --speed 0.3
grep -qF "the catalogue's law buffer: points of the catalogue" "$out" || fail "not named"
! grep -q "energy of themselves" "$err" || fail "the law has the loss"
expect 0 percuss query --a ball --b felt --speed 0.3 --json
[ "$(field contact_model)" = law ] || fail "$(field contact_model)"
awk -v e="$(field restitution)" 'BEGIN { exit !(e > 0.7 && e < 0.8) }' || fail "e = $(field restitution)"
expect 5 percuss query --a ball --b stop --speed 0.3 --contact-model law
says "options.contact_model: law: the catalogue has no law between steel and nylon (contacts[0])"

say "by finite elements it is not in the number either"
expect 0 percuss query --a ball --b bead --speed 0.3 --contact-model complete-fe --tolerance 0.05 --timeout 300
says "contacts[0]: what bead loses $lost"

say "what vibrates is damped by it, unless the catalogue says otherwise"
expect 0 percuss query --a ball --b bar --speed 0.3 --json
damping=$(field damping)
awk -v e="$damping" 'BEGIN { exit !(e > 0) }' || fail "damping: $damping J"
expect 0 percuss query --a ball --b bell --speed 0.3 --contact-model hertz --json
[ "$(field damping)" = 0 ] || [ "$(field damping)" = 0.0 ] || fail "damping: $(field damping) J"

say "a sweep counts it"
expect 0 percuss sweep --a ball --b stop --speed 0.1:0.5:5 --contact-model hertz
once "points: 5 of 5, first at 0.1 m/s: contacts[0]: what stop loses $lost" "$err"
expect 0 percuss sweep --a ball --b stop --speed 0.1:0.5:5 --contact-model hertz --json
sed -n '/^  "warnings": \[/,/^  \]/p' "$out" >"$work/list"
once "what stop loses" "$work/list"
expect 0 percuss sweep --a ball --b mat --speed 0.1:0.5:5
once "points: 5 of 5, first at 0.1 m/s: contacts[0]: materials as soft as that of mat" "$err"

say "an ensemble too"
expect 0 percuss ensemble --a ball --b stop --speed uniform:0.1:0.5 --samples 100 --contact-model hertz
once "samples: 100 of 100, first 0: contacts[0]: what stop loses $lost" "$err"
expect 0 percuss ensemble --a ball --b mat --speed uniform:0.1:0.5 --samples 100 --json
sed -n '/^  "warnings": \[/,/^  \]/p' "$out" >"$work/list"
once "samples: 100 of 100, first 0: contacts[0]: materials as soft as that of mat" "$work/list"

say "and a comparison, and a calibration of its result"
{
    echo "speed,restitution,sub_impacts,first_impulse"
    percuss sweep --a ball --b bar --speed 0.2:0.5:6 --contact-model hertz --csv | awk -F, 'NR > 1 { printf "%s,%s,%s,%s\n", $1, $2, 1, $4 * 1.01 }'
} >"$work/impulses.csv" 2>/dev/null
expect 0 percuss compare "$work/impulses.csv" --a ball --b bar --contact-model hertz
once "twins: 6 of 6, first impact 1: contacts[0]: what bar loses $lost" "$err"
expect 0 percuss compare "$work/impulses.csv" --a ball --b bar --contact-model hertz --json
once "what bar loses" "$out"
code=0
percuss calibrate "$work/impulses.csv" --a ball --b bar --fit density:bar --contact-model hertz >"$out" 2>"$err" || code=$?
[ "$code" -le 1 ] || fail "exit code $code"
once "twins: 6 of 6, first impact 1: contacts[0]: what bar loses $lost" "$err"
percuss calibrate "$work/impulses.csv" --a ball --b bar --fit density:bar --contact-model hertz --json >"$out" 2>"$err" || code=$?
once "what bar loses" "$out"
stop_daemon

say "one that no material has is refused, with what is allowed"
sed 's/loss_factor: 0.06/loss_factor: 6/' "$work/catalogue.yaml" >"$work/wrong.yaml"
expect 2 "$bin/percuss" query --local --catalogue "$work/wrong.yaml" --a ball --b stop --speed 0.3
says "wrong.yaml:3: materials.nylon.loss_factor: 6: must be a ratio >= 0 and < 2"
sed 's/time: 30 us/time: 30 um/' "$work/catalogue.yaml" >"$work/wrong.yaml"
expect 2 "$bin/percuss" query --local --catalogue "$work/wrong.yaml" --a ball --b pad --speed 0.3
says "wrong.yaml:6: materials.pom.relaxation[0].time: 30 um: must be a time"

say "soft, lossy bodies: on beams, with surfaces that come back slowly, with a gap, with next to no loss"
cat >"$work/soft.yaml" <<END
materials:
  soft: {young: 5e7, poisson: 0.45, density: 1100, loss_factor: 1.6, yield: none}
  slow: {young: 5e6, poisson: 0.49, density: 1100, loss_factor: 1.0, yield: none}
  tiny: {young: 5e7, poisson: 0.45, density: 1100, loss_factor: 1e-16, yield: none}
  steel: {young: 210e9, poisson: 0.3, density: 7800}
bodies:
  soft-ball: {shape: sphere, material: soft, radius: 0.02}
  slow-ball: {shape: sphere, material: slow, radius: 0.1}
  tiny-ball: {shape: sphere, material: tiny, radius: 0.015}
  steel-ball: {shape: sphere, material: steel, radius: 0.02}
  beam: {shape: beam, material: soft, radius: 0.01, length: 0.3, theory: timoshenko, ends: free, damping: 0}
  wall: {shape: half-space, material: steel}
END
# pair A B SPEED LOW HIGH: a final restitution between these
pair() {
    expect 0 "$bin/percuss" query --local --catalogue "$work/soft.yaml" --a "$1" --b "$2" --speed "$3" --json
    awk -v e="$(field restitution)" -v low="$4" -v high="$5" 'BEGIN { exit !(e > low && e < high) }' ||
        fail "$1 on $2: $(field restitution)"
}
# the compliance in series must not be more negative than the law in use bears; the first contacts
# part and grow again, the second ones find what is left (0.368 and 0.592 if nothing were)
pair soft-ball beam 0.2 0.35 0.357
pair steel-ball beam 0.2 0.612 0.616
# it has parted long before its surface has come back, which is behind the horizon
pair slow-ball wall 0.3 0.307 0.309
pair tiny-ball wall 0.2 0.9999 1.0001
