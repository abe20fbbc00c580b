#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-reduce makes a body for the catalogue from a mesh.
. "$(dirname "$0")/lib.sh"

# block NX NY NZ: a deck of cubes of 20 nodes and 5 mm; set `low` holds x = 0, the cubes are `left` up to
# the middle and `right` beyond
block() {
    awk -v nx="$1" -v ny="$2" -v nz="$3" 'function node(i, j, k) { return 1 + i + (2 * nx + 1) * (j + (2 * ny + 1) * k) }
    BEGIN {
        print "*NODE"
        for (k = 0; k <= 2 * nz; k++)
            for (j = 0; j <= 2 * ny; j++)
                for (i = 0; i <= 2 * nx; i++)
                    if (i % 2 + j % 2 + k % 2 < 2)
                        printf "%d, %g, %g, %g\n", node(i, j, k), 2.5 * i, 2.5 * j, 2.5 * k
        split("0 0 0 2 0 0 2 2 0 0 2 0 0 0 2 2 0 2 2 2 2 0 2 2 1 0 0 2 1 0 1 2 0 0 1 0 1 0 2 2 1 2 1 2 2 0 1 2 " \
            "0 0 1 2 0 1 2 2 1 0 2 1", at, " ")
        for (a = 0; a < nx; a++) {
            printf "*ELEMENT, TYPE=C3D20, ELSET=%s\n", a < nx / 2 ? "left" : "right"
            for (b = 0; b < ny; b++)
                for (c = 0; c < nz; c++) {
                    printf "%d", ++element
                    for (n = 0; n < 20; n++)
                        printf ",%s %d", n == 10 ? "\n" : "", node(2 * a + at[3 * n + 1], 2 * b + at[3 * n + 2], 2 * c + at[3 * n + 3])
                    print ""
                }
        }
        print "*NSET, NSET=low"
        for (k = 0; k <= 2 * nz; k++)
            for (j = 0; j <= 2 * ny; j++)
                if (j % 2 + k % 2 < 2)
                    printf "%d,\n", node(0, j, k)
    }'
}

reduce() { # reduce ARGUMENT...: of the block
    "$bin/percuss-reduce" "$work/block.inp" --unit mm -o "$work/block.h5" "$@"
}

block 8 3 2 >"$work/block.inp"
steel="--young 210e9 --poisson 0.3 --density 7800"

say "mass and modes of a block of 40 x 15 x 10 mm"
expect 0 reduce $steel --modes 12
says '12 modes: about'
shows '48 elements'
shows 'mass            0.0468 kg'
shows 'centre          0.02 0.0075 0.005 m'
shows 'volume          6e-06 m^3'
shows 'modes           12; by inertia'
[ -s "$work/block.h5" ] || fail "no file"

say "the same as JSON, with a file for ParaView; the same body has the same name"
expect 0 reduce $steel --modes 12 --json --vtk "$work/block.vtu"
[ "$(field modes)" -eq 12 ] || fail "modes $(field modes)"
[ "$(field rigid_motions)" -eq 6 ] || fail "rigid motions $(field rigid_motions)"
grep -q 'Name="mode 12: ' "$work/block.vtu" || fail "no mode in the file for ParaView"
first=$(field hash)
expect 0 reduce $steel --modes 12 --json
[ "$(field hash)" = "$first" ] || fail "another hash"

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

say "refusals"
expect 1 reduce
says 'has no material: give --material NAME'
expect 1 reduce $steel --fixed high
says '--fixed: high: the mesh has'
expect 1 reduce --catalogue "$work/catalogue.yaml" --material steal
says 'steal'
expect 1 reduce --catalogue "$work/catalogue.yaml" --material steel --part middle=light
says '--part: middle: the mesh has 2 parts'
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
expect 2 reduce --young 210e9
says 'must be given together'
expect 2 reduce $steel --modes 5 --max-frequency 100
expect 2 reduce $steel --unit furlong
expect 2 "$bin/percuss-reduce" "$work/block.inp" $steel
