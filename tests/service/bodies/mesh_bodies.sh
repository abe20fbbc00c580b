#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# Bodies reduced from meshes, from the catalogue's folder to answers at sites that have names.
. "$(dirname "$0")/../support/lib.sh"

"$build/tests/write_mesh" beam 60 "$work/part.h5"
awk '/^bodies:/ { print; print "  part: {shape: mesh, file: part.h5, sites: {middle: {point: [500, 0, 10]}, third: {point: [350, 0, 10]}, end: {point: [1000, 0, 0]}, above: {point: [350, 0, 11]}}}"; print "  lump: {shape: mesh, file: part.h5, rigid: true, sites: {middle: {point: [500, 0, 10]}}}"; print "  own-beam: {shape: beam, material: aluminium, radius: 0.010, length: 1.0, modes: 60}"; next } { print }' \
    "$work/catalogue.yaml" >"$work/new" && mv "$work/new" "$work/catalogue.yaml"
start_daemon

# near A B ALLOWED
near() {
    awk -v a="$1" -v b="$2" -v r="$3" 'BEGIN { d = a - b; exit !(d * d <= r * r) }'
}

# e ARGUMENT...: the restitution of a query with half-spaces, as a beam's
e() {
    expect 0 percuss query --a steel-sphere --speed 0.2 --tolerance 1e-6 --compliance half-space --json "$@"
    field restitution
}

say "it is listed with its frame and its sites"
expect 0 percuss bodies
shows "centre of mass at (500, 0, 0) of the mesh's frame"
shows "sites middle"
expect 0 percuss bodies --json
shows '"name": "third"'

say "a site's name is a place: the first is the default"
near "$(e --b part)" "$(e --b own-beam)" 1e-5 || fail "another answer in the middle"
near "$(e --b part --at-b middle)" "$(e --b part)" 1e-15 || fail "the default is another site"
near "$(e --b part --at-b third)" "$(e --b own-beam --at 0.35)" 1e-5 || fail "another answer at 0.35"
expect 2 percuss query --a steel-sphere --b part --at-b nowhere --speed 0.2
says "part has the sites middle, third, end, above"
expect 2 percuss query --a steel-sphere --b al-beam --at-b middle --speed 0.2
says "no sites with names"

say "one declared off the surface is moved onto it, and that is said"
near "$(e --b part --at-b above)" "$(e --b part --at-b third)" 1e-9 || fail "another answer above"
expect 0 percuss bodies
shows "1 site moved onto the surface by up to 0.001 m"
expect 0 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
says "bodies.part.sites.above.point: lies 0.001 m off the surface: moved onto it, to [350, "

say "a rigid one"
expect 0 percuss query --a steel-sphere --b lump --speed 0.2 --json
shows '"rigid": true'

say "sweeps and ensembles"
expect 0 percuss sweep --a steel-sphere --b part --at-b third --speed 0.1:0.3:3 --csv
[ "$(grep -c '^0\.' "$out")" -eq 3 ] || fail "no three speeds"
expect 0 percuss ensemble --a steel-sphere --b part --at-b end --speed uniform:0.2:0.3 \
    --input scale@part=uniform:0.9:1.1 --input young@part=uniform:65e9:75e9 --samples 20 --json
shows scale

say "a file that goes bad keeps the old catalogue"
cp "$work/part.h5" "$work/kept"
: >"$work/part.h5"
kill -HUP "$daemon"
refused() {
    logged "part.h5: cannot be opened"
}
wait_for 10 refused || fail "the bad file is not complained about"
near "$(e --b part)" "$(e --b own-beam)" 1e-5 || fail "no answer from the old catalogue"
mv "$work/kept" "$work/part.h5"
stop_daemon

say "and one that never was: the daemon does not start"
rm "$work/part.h5"
expect 1 "$bin/percussd" --config "$work/percussd.yaml" --domain "$domain" --check-config
says "part.h5: cannot be opened: No such file"
