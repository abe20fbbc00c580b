#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-reduce makes a body for the catalogue from a mesh.
. "$(dirname "$0")/../support/lib.sh"
. "$support/block_deck.sh"

reduce() { # reduce ARGUMENT...: of the block
    "$bin/percuss-reduce" "$work/block.inp" --unit mm -o "$work/block.h5" "$@"
}

block 8 3 2 >"$work/block.inp"
steel="--young 210GPa --poisson 0.3 --density 7.8g/cm^3"

say "mass, modes and flexibility of a block of 40 x 15 x 10 mm"
expect 0 reduce $steel --modes 12
says '12 modes: about'
shows '48 elements'
shows 'part            "left" of given (210 GPa, 0.3, 7800 kg/m^3): 24 elements, 3e-06 m^3, 0.0234 kg'
shows 'part            "right" of given'
shows 'mass            0.0468 kg'
shows 'centre          0.02 0.0075 0.005 m'
shows 'volume          6e-06 m^3'
shows 'modes           12; by inertia'
shows 'serves          contacts of'
shows 'flexibility '
[ -s "$work/block.h5" ] || fail "no file"

say "the same as JSON, with a file for ParaView; the same body has the same name"
expect 0 reduce $steel --modes 12 --json --vtk "$work/block.vtu"
[ "$(field modes)" -eq 12 ] || fail "modes $(field modes)"
[ "$(field rigid_motions)" -eq 6 ] || fail "rigid motions $(field rigid_motions)"
awk -v last="$(sed -n 's/.*"frequencies": .*, \([0-9.e+]*\)\].*/\1/p' "$out")" -v good="$(field good_to)" \
    -v least="$(field shortest_contact)" 'BEGIN {
        f = last < good ? last : good
        exit !(least * f > 2.999999 && least * f < 3.000001) }' ||
    fail "shortest contact $(field shortest_contact) s"
[ "$(field faces_unknown)" -eq 0 ] || fail "$(field faces_unknown) faces without a flexibility"
grep -q 'Name="mode 12: ' "$work/block.vtu" || fail "no mode in the file for ParaView"
first=$(field hash)
expect 0 reduce $steel --modes 12 --json
[ "$(field hash)" = "$first" ] || fail "another hash"
expect 0 reduce $steel --modes 12 --json --site 20,7.5,10
[ "$(field hash)" != "$first" ] || fail "the same hash with a site"

say "its flexibility later: the sites that are asked for, as those made ahead"
later() { # later ARGUMENT...: of the block at its site
    "$bin/percuss-reduce" --add-sites "$work/later.h5" "$@"
}
asks() { # asks BODY ARGUMENT...: at the site
    b=$1
    shift
    "$bin/percuss" query --local --catalogue "$work/later.yaml" --a ball --b "$b" --at-b top --speed 0.3 "$@"
}
cat >"$work/later.yaml" <<YAML
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.006}
  ahead: {shape: mesh, file: block.h5, sites: {top: {point: [20, 7.5, 10]}}}
  later: {shape: mesh, file: later.h5, sites: {top: {point: [20, 7.5, 10]}}}
YAML
expect 0 reduce $steel --modes 12 --flexibility later -o "$work/later.h5"
[ ! -e "$work/later.h5.sites" ] || fail "sites that nobody asked for"
expect 5 asks later
says "its flexibility there is not solved for yet: percuss-reduce --add-sites '$work/later.h5' --site 20,7.5,10 solves it"
mv "$work/block.inp" "$work/elsewhere.inp"
expect 1 later --site 33,4mm,10
says "block.inp: No such file"
block 8 2 3 >"$work/block.inp"
expect 1 later --site 33,4mm,10
says "block.inp: is not the mesh that $work/later.h5 was made of"
[ ! -e "$work/later.h5.sites" ] || fail "sites of another mesh"
expect 0 later --site 33,4mm,10 --site 20,7.5,10 --site 20,0.1,10 "$work/elsewhere.inp"
mv "$work/elsewhere.inp" "$work/block.inp"
says "warning: --site: 20,0.1,10: its flexibility is not known: the mesh is too coarse so near to an edge"
shows "later.h5: 3 sites added, 3 in all"
expect 0 later --site 20.1,7.5,10 --json
[ "$(field sites_added)" -eq 0 ] || fail "$(field sites_added) sites added within reach of another"
expect 0 asks later --json
cp "$out" "$work/later.json"
expect 0 asks ahead --json
# what a face's shape functions leave of the site's own
awk -v a="$(field restitution)" -v b="$(sed -n 's/.*"restitution": \([0-9.e-]*\),.*/\1/p' "$work/later.json" | head -n 1)" \
    'BEGIN { exit !(b > 0 && (a - b) ^ 2 < 1e-10) }' || fail "another answer than ahead"
cat >"$work/two.json" <<'JSON'
{"bodies": [{"id": "ball", "position": [0, 0, 0.011], "velocity": [0, 0, -0.3]},
  {"id": "ball", "position": [0.013, -0.0035, 0.011], "velocity": [0, 0, -0.3]}, {"id": "later"}],
 "contacts": [{"a": 0, "b": 2, "point": [0, 0, 0.005], "normal": [0, 0, 1]},
  {"a": 1, "b": 2, "point": [0.013, -0.0035, 0.005], "normal": [0, 0, 1]}]}
JSON
expect 0 "$bin/percuss" query --local --catalogue "$work/later.yaml" --request "$work/two.json"
says "contacts[1]: of what contacts on later do to each other its modes alone are known"
expect 1 "$bin/percuss-reduce" --add-sites "$work/block.h5" --site 20,7.5,10
says "block.h5: was not made with --flexibility later"
if [ "$(id -u)" = 0 ]; then
    mkdir "$work/kept" && cp "$work/later.h5" "$bin/percuss-reduce" "$work/kept"
    chmod 711 "$work"
    expect 1 setpriv --reuid=65534 --regid=65534 --clear-groups "$work/kept/percuss-reduce" \
        --add-sites "$work/kept/later.h5" --site 20,7.5,10
    says "kept/later.h5.sites: cannot be written: Permission denied"
    : >"$work/kept/later.h5.sites" && chmod 666 "$work/kept/later.h5.sites"
    expect 1 setpriv --reuid=65534 --regid=65534 --clear-groups "$work/kept/percuss-reduce" \
        --add-sites "$work/kept/later.h5" --site 20,7.5,10
    says "kept/later.h5.sites: its folder cannot be written: Permission denied"
fi

say "two materials by name, held at one end, all modes below a frequency"
cat >"$work/catalogue.yaml" <<YAML
materials:
  steel: {young: 210e9, poisson: 0.3, density: 7800}
  light: {young: 70e9, poisson: 0.33, density: 2700}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.01}
YAML
expect 0 reduce --catalogue "$work/catalogue.yaml" --material steel --part right=light --fixed low \
    --max-frequency 40e3 --json
[ "$(field rigid_motions)" -eq 0 ] || fail "rigid motions $(field rigid_motions)"
[ "$(field modes)" = "$(field confirmed)" ] || fail "$(field modes) modes of $(field confirmed)"
[ "$(field mass | cut -c1-6)" = 0.0315 ] || [ "$(field mass | cut -c1-6)" = 0.0314 ] || fail "mass $(field mass)"

# CalculiX's elements of 20 nodes are ours: its matrices give our frequencies
if command -v ccx >/dev/null; then
    say "matrices that CalculiX has assembled"
    { cat "$work/block.inp" && cat <<INP; } >"$work/ccx.inp"
*MATERIAL, NAME=steel
*ELASTIC
210000, 0.3
*DENSITY
7.8e-9
*SOLID SECTION, ELSET=left, MATERIAL=steel
*SOLID SECTION, ELSET=right, MATERIAL=steel
*BOUNDARY
low, 1, 3
*STEP
*FREQUENCY, SOLVER=MATRIXSTORAGE
5
*END STEP
INP
    (cd "$work" && ccx ccx >/dev/null 2>&1)
    reduce_ccx() {
        "$bin/percuss-reduce" "$work/ccx.inp" --unit mm -o "$work/block.h5" --modes 5 --json "$@"
    }
    expect 0 reduce_ccx --fixed low
    mv "$out" "$work/own.json"
    expect 0 reduce_ccx --stiffness "$work/ccx.sti" --mass "$work/ccx.mas" --freedoms "$work/ccx.dof"
    [ "$(field held)" = "(matrices)" ] || fail "held $(field held)"
    # 14 digits of each entry are in the file
    grep -h '"frequencies"' "$work/own.json" "$out" | tr -d '[],' | awk '
        NR == 1 { split($0, one, " ") }
        NR == 2 { for (i = 2; i <= NF; i++) if (($i / one[i] - 1) ^ 2 > 1e-18) bad = 1 }
        END { exit bad || NR != 2 }' || fail "other frequencies"
    expect 1 reduce_ccx --stiffness "$work/ccx.mas" --mass "$work/ccx.sti" --freedoms "$work/ccx.dof"
    says 'are they exchanged, of another mesh, or in other units?'
    head -n 200 "$work/ccx.sti" >"$work/short.sti"
    expect 1 reduce_ccx --stiffness "$work/short.sti" --mass "$work/ccx.mas" --freedoms "$work/ccx.dof"
    says 'on the diagonal: must be > 0; is the file whole?'
fi

say "a number of modes that would cut between the copies of a frequency takes both"
block 6 2 2 | awk -F, '/^\*/ { nodes = /^\*NODE/ } nodes && NF == 4 { printf "%s,%.9g,%s,%s\n", $1, 4 * $2, $3, $4; next }
    { print }' >"$work/square.inp"
expect 0 "$bin/percuss-reduce" "$work/square.inp" --unit mm -o "$work/square.h5" $steel --modes 1
shows 'modes           2; by inertia'
shows '1 were asked for, the last of which has the frequency of the next: copies stay together'

say "a slender bar held at one end and a single mode: statics converge far above its first frequency"
awk -F, '/^\*/ { nodes = /^\*NODE/ } nodes && NF == 4 { printf "%s,%.9g,%s,%s\n", $1, 3 * $2, $3, $4; next }
    { print }' "$work/block.inp" >"$work/long.inp"
expect 0 "$bin/percuss-reduce" "$work/long.inp" --unit mm -o "$work/long.h5" $steel --modes 1 --fixed low
shows 'without 1 modes'

say "refusals"
expect 1 reduce
says 'has no material: give --material NAME'
expect 1 reduce $steel --fixed high
says '--fixed: high: must be the name of a set of nodes: '
expect 1 reduce --catalogue "$work/catalogue.yaml" --material steal
says 'steal'
expect 1 reduce --catalogue "$work/catalogue.yaml" --material steel --part middle=light
says '--part: middle: the mesh has 2 parts'
expect 1 reduce $steel --site 20,7.5,11 --site 20,7.5,14
says '--site: 20,7.5,14: is 4 mm off the surface'
expect 1 reduce $steel --max-frequency 10
says 'there are 0 modes below'
expect 1 reduce $steel --modes 12 -o /proc/block.h5
says '/proc/block.h5'
expect 1 "$bin/percuss-reduce" "$work/none.inp" $steel -o "$work/none.h5"
says 'none.inp'
sed 's/C3D20/C3D8/' "$work/block.inp" >"$work/linear.inp"
expect 1 "$bin/percuss-reduce" "$work/linear.inp" $steel -o "$work/none.h5"
says 'C3D8'
[ ! -e "$work/none.h5" ] || fail "a file of nothing"
expect 1 reduce --young 210e9
says 'has no material: give'
expect 2 reduce --young 210mm --poisson 0.3 --density 7800
says "--young: 210mm: must be a modulus, 1 to 1e+15 Pa, or with a unit, such as 70 GPa"
expect 2 reduce $steel --modes 5 --max-frequency 100
expect 1 "$bin/percuss-reduce" "$work/block.inp" --unit mm $steel -o "$work/nowhere/block.h5"
says "nowhere/block.h5: cannot be written"
expect 2 reduce $steel --unit furlong
expect 2 reduce $steel --flexibility never
expect 2 later
says "--add-sites: needs --site X,Y,Z"
expect 2 later --site 1,2,3 --unit mm
says "must be given with --site, FILE, --json and --progress alone"
expect 1 later --site 1,2
says "--site: 1,2: must be three numbers"
expect 2 reduce $steel --stiffness "$work/ccx.sti"
expect 2 reduce $steel --site 1,2
expect 2 "$bin/percuss-reduce" "$work/block.inp" $steel
