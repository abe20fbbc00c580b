#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Oblique impacts with friction: the daemon's answer is that of the same process, a coefficient of the catalogue is one of
# the request, and bodies and methods without tangential forces are refused by name.
. "$(dirname "$0")/../support/lib.sh"

cat >"$work/catalogue.yaml" <<'YAML'
materials:
  steel:     {young: 210 GPa, poisson: 0.30, density: 7800, yield: none}
  soft:      {young: 210 GPa, poisson: 0.30, density: 7800, yield: 200 MPa}
  aluminium: {young: 70 GPa, poisson: 0.33, density: 2700, yield: none}
bodies:
  ball:  {shape: sphere, material: steel, radius: 15 mm}
  soft:  {shape: sphere, material: soft, radius: 15 mm}
  beam:  {shape: beam, material: aluminium, radius: 10 mm, length: 1, ends: free}
  block: {shape: block, material: steel, size: [100 mm, 100 mm, 20 mm]}
YAML
{
    cat "$work/catalogue.yaml"
    echo "friction:"
    echo "- {between: [aluminium, steel], coefficient: 0.3}"
} >"$work/listed.yaml"
start_daemon

# hit B ARGUMENT...: the daemon is asked; within C ARGUMENT...: the same in this process, of the catalogue C
hit() {
    struck=$1
    shift
    percuss query --a ball --b "$struck" --speed 0.3 --angle 30 "$@"
}
within() {
    catalogue=$1
    shift
    "$bin/percuss" query --local --catalogue "$work/$catalogue.yaml" --a ball --b beam --speed 0.3 --angle 30 "$@"
}

# answer: without the server's name; bare: nor what tells catalogues and requests apart
answer() {
    numbers "$out" | sed '/^  "server":/d'
}
bare() {
    answer | sed -e '/^  "catalogue_revision":/d' -e '/^ *"state":/d' -e '/without a coefficient of friction/d'
}

say "over DDS and in process: the same bits"
expect 0 hit beam --friction 0.3 --json
answer >"$work/asked"
bare >"$work/bare"
[ "$(field friction_state)" = reversed ] || fail "the first blow does not throw the surface back"
grep -q '"tangential_restitution": 0\.04' "$out" || fail "the tangential restitution"
awk '/^  "energy"/ { inside = 1 } inside && /"friction":/ { found = $2 + 0 > 2.5e-4 && $2 + 0 < 3.5e-4 }
    END { exit !found }' "$out" || fail "what was lost to friction"
expect 0 within catalogue --friction 0.3 --json
answer | cmp - "$work/asked" || fail "in process the answer is another one"

say "a pair of the catalogue answers as --friction"
expect 0 within listed --json
bare | cmp - "$work/bare" || fail "the catalogue's coefficient gives another answer"
expect 0 within listed --friction 0.1 --json
! bare | cmp -s - "$work/bare" || fail "the request's coefficient does not go before the catalogue's"

say "without friction it is as if no coefficient were stated"
expect 0 hit beam --json
bare >"$work/never"
expect 0 hit beam --friction 0.3 --friction-law none --json
bare | cmp - "$work/never" || fail "friction-law none moves the answer"
[ "$(field friction_state)" = none ] || fail "a state of friction without friction"

say "a contact that yields has friction as well"
expect 0 hit soft --friction 0.3 --json
[ "$(field plastic)" != 0 ] || fail "the soft body leaves no dent"
[ "$(field friction_state)" != none ] || fail "no friction where the contact yields"

say "a block answers, and its mesh as the block does, off its middle, where normal and tangents couple"
. "$support/block_deck.sh"
block 12 8 4 >"$work/slab.inp"
"$bin/percuss-reduce" "$work/slab.inp" -o "$work/slab.h5" -u mm --young 70e9 --poisson 0.33 --density 2700 --site 45,30,20 >/dev/null 2>&1 ||
    fail "the mesh is not reduced"
"$build/tests/write_mesh" beam 60 "$work/older.h5"
{
    cat "$work/catalogue.yaml"
    echo "  pebble: {shape: sphere, material: steel, radius: 6 mm}"
    echo "  slab: {shape: block, material: aluminium, size: [60 mm, 40 mm, 20 mm]}"
    echo "  twin: {shape: mesh, file: slab.h5}"
    echo "  older: {shape: mesh, file: older.h5, sites: {top: {point: [500, 0, 10]}}}"
} >"$work/slabs.yaml"
# on_slab B: its tangential impulse between both tangents' directions
on_slab() {
    cat >"$work/slab.json" <<JSON
{"bodies": [{"id": "pebble", "position": [0.015, 0.01, 0.016], "velocity": [0.1, 0.05, -0.26]}, {"id": "$1"}],
 "contacts": [{"a": 0, "b": 1, "point": [0.015, 0.01, 0.01], "normal": [0, 0, 1], "tangent": [1, 0, 0], "friction": 0.3}],
 "options": {"tolerance": 1e-5}}
JSON
    expect 0 "$bin/percuss" query --local --catalogue "$work/slabs.yaml" --request "$work/slab.json" --json
    awk '/^ *"impulse_tangential": \[/ { getline; print $1 + 0; getline; print $1 + 0; exit }' "$out"
}
block=$(on_slab slab)
mesh=$(on_slab twin)
! grep -q "along its surface" "$out" || fail "the file does not say how the mesh gives way along its surface"
# 2e-5 is seen, by the block's polynomials and the elements of 5 mm; 4e-4 where it is taken as across the surface
echo $block $mesh | awk '{ off = ($3 - $1) ^ 2 + ($4 - $2) ^ 2; exit !($1 < -1e-4 && $2 < -3e-5 && off < 1e-8 * ($1 ^ 2 + $2 ^ 2)) }' ||
    fail "the mesh of a block answers $mesh, the block $block"

say "an older release's file has friction, with a warning"
expect 0 "$bin/percuss" query --local --catalogue "$work/slabs.yaml" --a ball --b older --speed 0.3 --angle 30 --friction 0.2
says "contacts[0].friction: the file of older does not say how it gives way along its surface"
says "percuss-reduce of this release writes that: reduce its mesh again"

say "the second method has friction as well"
expect 0 hit beam --friction 0.3 --method cvode

say "what has no tangential forces is refused by name"
expect 5 hit beam --friction 0.3 --contact-model complete-fe
says "contacts[0].friction: finite elements have no friction"
expect 2 hit beam --friction 11
says "a coefficient of 0 to 10 is needed"
expect 0 hit beam --friction 0.3

say "an ensemble of coefficients: statistics, samples and influences of the tangential impulse"
spread() {
    percuss ensemble --a ball --b beam --angle 30 "$@"
}
expect 0 spread --speed uniform:0.28:0.32 --input friction=log-normal:0.3:0.06 --samples 64 --csv "$work/mu.csv" -v
shows "of impulse_tangential_1"
shows "  restitution_kinematic "
head -n 1 "$work/mu.csv" | grep -q '^speed,friction,.*,status,impulse_tangential_1,impulse_tangential_2,tangential' ||
    fail "no tangential columns"
awk -F, 'NR > 1 && $9 == "OK" && $10 < -0.001 && $10 > -0.01 && $2 > 0 { n++ } END { exit n != 64 }' "$work/mu.csv" ||
    fail "the tangential impulses"
expect 0 spread --speed 0.3 --friction 0.3 --model-error --samples 32 --json
grep -q '"input": "model-friction"' "$out" || fail "the stated coefficient has no deviation"
grep -q '"quantity": "impulse_tangential_1"' "$out" || fail "no tangential impulse in JSON"
expect 5 spread --speed 0.3 --input model-friction=normal:0:1 --samples 8
says "inputs[1].name: model-friction: contacts[0] must have friction"
expect 5 spread --speed 0.3 --friction-law none --input friction=0.3 --samples 8
says "inputs[1].name: friction: must be another one with options.friction none"
expect 5 spread --speed 0.3 --input friction=uniform:-0.1:0.3 --samples 8
says "inputs[1].first: -0.1: must be a coefficient >= 0 and <= 10"
expect 0 spread --speed uniform:0.28:0.32 --samples 8 --csv "$work/none.csv"
head -n 1 "$work/none.csv" | grep -q 'status$' || fail "columns of friction without friction"
stop_daemon
