#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-tables computes tables ahead of time; percussd takes them.
. "$(dirname "$0")/../support/lib.sh"

tables() { # tables ARGUMENT...: coarse and shallow, for the time's sake
    "$bin/percuss-tables" --catalogue "$work/catalogue.yaml" --folder "$work/tables" \
        --speed 0.5 --resolution 6 "$@"
}

say "one pair; what is there already is left"
expect 0 tables --a al-rod-2 --b glass-sphere
shows 'al-575 on glass: up to'
[ "$(ls -A "$work/tables" | wc -l)" -eq 1 ] || fail "not one file"
expect 0 tables --a glass-sphere --b al-rod-2
shows 'glass on al-575: is there'
[ "$(ls -A "$work/tables" | wc -l)" -eq 1 ] || fail "not one file"

say "a damaged one is computed anew"
echo '{}' >"$work/tables/$(ls "$work/tables")"
expect 0 tables --a glass-sphere --b al-rod-2
shows 'glass on al-575: up to'

say "all that a catalogue needs: circular contacts of which one may yield"
cat >"$work/catalogue.yaml" <<YAML
materials:
  glass:  {young: 48e9, poisson: 0.20, density: 2800}
  al-575: {young: 70e9, poisson: 0.33, density: 2700, yield: 575e6, tangent: 0}
bodies:
  glass-sphere: {shape: sphere, material: glass, radius: 0.010}
  glass-wall: {shape: half-space, material: glass}
  rod: {shape: rod, material: al-575, radius: 0.010, length: 1.0}
  beam: {shape: beam, material: al-575, radius: 0.010, length: 1.0}
YAML
expect 0 tables
[ "$(wc -l <"$out")" -eq 1 ] || fail "not one pair"
shows 'glass on al-575: is there'

say "bodies that are given as meshes: those that are reduced count, others are named"
. "$support/block_deck.sh"
block 4 2 2 >"$work/block.inp"
cp "$work/catalogue.yaml" "$work/plain.yaml"
cat >>"$work/catalogue.yaml" <<YAML
  block: {shape: mesh, file: block.inp, unit: mm, material: glass}
YAML
expect 0 tables
shows 'block: left out, as its mesh is not reduced yet'
shows 'glass on al-575: is there'
expect 1 tables --a rod --b block
says 'block: its mesh is not reduced: --bodies DIR must be'
settings "bodies: reduced"
start_daemon
reduced() {
    logged "block: reduced"
}
wait_for 100 reduced || fail "not reduced"
stop_daemon
expect 0 tables --bodies "$work/reduced"
[ "$(wc -l <"$out")" -eq 1 ] || fail "not one pair"
expect 1 tables --bodies "$work/reduced" --a rod --b block
says 'rod on block: one must be a sphere'
cp "$work/plain.yaml" "$work/catalogue.yaml"

settings "tables: tables"
start_daemon
logged 'tables: 1 from' || fail "the daemon does not take it"
expect 0 percuss query --a glass-sphere --b rod --speed 0.8 --json --contact-model table
[ "$(field contact_model)" = table ] || fail "model $(field contact_model)"
stop_daemon

say "refusals"
expect 1 tables --a glass-sphere --b nobody
says 'nobody: must be the id of a body'
expect 1 tables --a glass-sphere --b glass-wall
says 'neither material has a yield'
expect 1 tables --a rod --b beam
says 'one must be a sphere'
expect 2 tables --a rod
expect 2 tables --speed fast
expect 2 "$bin/percuss-tables" --folder "$work/tables"
expect 1 "$bin/percuss-tables" --catalogue "$work/none.yaml" --folder "$work/tables"
says 'none.yaml'
expect 1 "$bin/percuss-tables" --catalogue "$work/catalogue.yaml" --folder /proc/tables --speed 0.1 --resolution 6
says '/proc/tables'
