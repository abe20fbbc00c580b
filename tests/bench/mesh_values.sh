#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Bodies meshed by Gmsh, reduced and struck, beside numbers of other programs: what docs/lab/mesh.md states. Takes
# some fifteen minutes of one core and 3 GB.
# usage: mesh_values.sh BUILD OUTPUT [rod-end|patch|frequencies|rod|beam|plate|cylinder|oblique]...
# (default: all)
set -eu
build=$(cd "$1" && pwd)
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- rod-end patch frequencies rod beam plate cylinder oblique
export OMP_NUM_THREADS=1
domain=$((100 + $$ % 100))
daemon=
trap '[ -z "$daemon" ] || kill "$daemon" 2>/dev/null || true' EXIT

# name, drawing
mesh() {
    printf 'SetFactory("OpenCASCADE");\nMesh.ElementOrder = 2;\nMesh.HighOrderOptimize = 2;\n%s\n' "$2" >"$1.geo"
    gmsh -3 -format msh41 -o "$1.msh" "$1.geo" >"$1.log" 2>&1 || {
        cat "$1.log" >&2
        exit 1
    }
}

# name, drawing, the options of percuss-reduce
reduce() {
    name=$1
    mesh "$1" "$2"
    shift 2
    "$build/bin/percuss-reduce" "$name.msh" --unit mm -o "$name.h5" "$@" >"$name.txt" 2>"$name.log" || {
        cat "$name.log" >&2
        exit 1
    }
    grep -hE "elements,|^modes|written|s$" "$name.txt" | sed "s/^/# $name: /"
}

# a bar of radius 10 mm: length and element size in mm
bar() {
    echo "Cylinder(1) = {0, 0, 0, $1, 0, 0, 10}; Mesh.MeshSizeMin = $2; Mesh.MeshSizeMax = $2;"
}

serve() {
    [ -z "$daemon" ] || {
        kill "$daemon"
        wait "$daemon" || true
    }
    cat >catalogue.yaml
    printf 'catalogue: catalogue.yaml\n' >percussd.yaml
    "$build/bin/percussd" --config percussd.yaml --domain "$domain" 2>percussd.log &
    daemon=$!
    until grep -qs ready percussd.log; do
        kill -0 "$daemon" 2>/dev/null || {
            cat percussd.log >&2
            exit 1
        }
        sleep 0.1
    done
}

# what, speed, what others have: e, its error, length and peak of the first sub-impact
ask() {
    "$build/bin/percuss" query --a ball --b part --speed "$2" --domain "$domain" --tolerance 1e-5 >answer.txt 2>/dev/null || true
    awk -v what="$1" -v speed="$2" -v others="$3" '
        $1 == "restitution" && e == "" { e = $2 }
        $1 == "1" && NF == 7 { length_us = $3; impulse = $4; peak = $6 }
        END { printf "%s,%s,%s,%s,%s,%s,%s\n", what, speed, e, impulse, length_us, peak, others }' answer.txt
}

# the flexibility of a rod's end beyond L/(3 E A), in 1/(E b): what, name, E, L in m, others
end() {
    "$build/tests/bench/mesh_flexibility" "$2.h5" "$(awk -v l="$4" 'BEGIN { print 1000 * l }')" 0 0 |
        awk -v what="$1" -v E="$3" -v L="$4" -v others="$5" '{
            b = 0.010; printf "%s,,%.4f,,,,%s\n", what, ($1 - L / (3 * E * 3.14159265358979 * b * b)) * E * b, others }'
}

rod_end() {
    reduce end-33 "$(bar 1000 6)" --young 73e9 --poisson 0.33 --density 2780 --modes 60 --site 1000,0,0
    end "rod 1 m nu .33 end" end-33 73e9 1 "-.5876 +- .002"
    reduce end-30 "$(bar 400 4)" --young 73e9 --poisson 0.3 --density 2780 --modes 60 --site 400,0,0
    end "rod 40 b nu .3 end" end-30 73e9 0.4 "-.600 +- .003"
    reduce end-0 "$(bar 400 4)" --young 73e9 --poisson 0 --density 2780 --modes 60 --site 400,0,0
    end "rod 40 b nu 0 end" end-0 73e9 0.4 "-.648 +- .003"
}

# elements of so many mm within 4 mm of a point: size, x, y, z
finer() {
    echo "Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeExtendFromBoundary = 0; Field[1] = Ball;
Field[1].XCenter = $2; Field[1].YCenter = $3; Field[1].ZCenter = $4; Field[1].Radius = 4;
Field[1].VIn = $1; Field[1].VOut = 6; Field[1].Thickness = 12; Background Field = 1;"
}

# what, mesh with what goes before it, E, length that flexibility is stated in, what is taken off it (1/(E length)),
# place, radii in mm: pressures on the elements, and beside each of them the mean of point forces
press() {
    what=$1 mesh=$2 young=$3 length=$4 less=$5
    shift 5
    # words on purpose
    # shellcheck disable=SC2086
    "$build/tests/bench/mesh_patch" $mesh mm "$young" 0.33 "$@" 2>>patch.log |
        awk -F , -v what="$what" -v E="$young" -v l="$length" -v less="$less" '
            $1 == "point" { printf "%s by a point force,,%.4f,,,,\n", what, $2 * E * l - less }
            $1 == "patch" {
                printf "%s by a pressure of %s mm on elements of %s mm,,%.4f,,,,points %.4f\n", what, $2, $3,
                    $4 * E * l - less, $5 * E * l - less }'
}

patch() {
    stretch=$(awk 'BEGIN { print 100 / (3 * 3.14159265358979) }')
    for size in 6 1 0.5 0.35; do
        radii=3
        [ "$size" != 0.5 ] || radii="1 1.5 2 3 4"
        [ "$size" != 6 ] || radii=
        mesh "patch-end-$size" "$(bar 1000 6) Mesh.MeshSizeMin = $size; $(finer $size 1000 0 0)"
        # shellcheck disable=SC2086
        press "rod 1 m nu .33 end" "patch-end-$size.msh" 73e9 0.010 "$stretch" 1000 0 0 $radii
        mesh "patch-plate-$size" "Box(1) = {0, 0, 0, 120, 80, 12}; Mesh.MeshSizeMin = $size;
Mesh.MeshSizeMax = 6; $(finer $size 60 15 12)"
        # shellcheck disable=SC2086
        press "plate 120 x 80 x 12 mm 15 mm from its edge" "patch-plate-$size.msh" 73e9 0.012 0 60 15 12 $radii
    done
    patch_calculix
}

# the rod's end again, by the matrices that CalculiX makes of that mesh
patch_calculix() {
    command -v ccx >/dev/null || return 0
    { cat patch-end-0.5.geo && echo 'Physical Volume("part") = {1};'; } >patch-ccx.geo
    gmsh -3 -format inp -o patch-ccx.mesh patch-ccx.geo >patch-ccx.log 2>&1
    {
        sed '/^\*ELSET/,$d' patch-ccx.mesh
        printf '*MATERIAL, NAME=metal\n*ELASTIC\n73000, 0.33\n*DENSITY\n2.7e-9\n'
        printf '*SOLID SECTION, ELSET=Volume1, MATERIAL=metal\n'
        printf '*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n5\n*END STEP\n'
    } >patch-ccx.inp
    ccx patch-ccx >>patch-ccx.log 2>&1 || {
        cat patch-ccx.log >&2
        exit 1
    }
    press "rod 1 m nu .33 end by CalculiX's matrices" \
        "--matrices patch-ccx.sti patch-ccx.mas patch-ccx.dof patch-ccx.inp" 73e9 0.010 "$stretch" 1000 0 0 3
}

# each frequency once, in Hz, beside its theory
frequencies() {
    PERCUSS_FINE=1 PERCUSS_MEASURE=1 "$build/tests/physics_mesh_test_bars" >frequencies.txt 2>frequencies.log || {
        cat frequencies.log >&2
        exit 1
    }
    awk '/ RUN / { number = 0 }
        $2 == "frequency" && $5 != last {
            last = $5
            printf "%s frequency %d,,%.2f,,,,%.2f: off by %.1e\n", $1, ++number, $3 / 6.28318530717959,
                $5 / 6.28318530717959, $3 / $5 - 1 }' frequencies.txt
}

rod() {
    reduce rod "$(bar 1000 8)" --young 73e9 --poisson 0.33 --density 2780 --modes 160 --site 1000,0,0
    serve <<END
materials: {steel: {young: 210e9, poisson: 0.30, density: 7780}}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.015}
  part: {shape: mesh, file: rod.h5, sites: {end: {point: [1000, 0, 0]}}}
END
    for case in 0.05:.7769 0.1:.7256 0.2:.6710 0.3:.6377 0.5:.5942; do
        ask rod "${case%:*}" "${case#*:} +- .0006"
    done
}

steel='materials: {steel: {young: 210e9, poisson: 0.30, density: 7800}}
bodies:
  ball: {shape: sphere, material: steel, radius: 0.015}'
aluminium="--young 70e9 --poisson 0.33 --density 2700"

beam() {
    # words on purpose
    # shellcheck disable=SC2086
    reduce beam "$(bar 1000 "${PERCUSS_BEAM_MM:-4}")" $aluminium --modes 220 --site 500,0,10
    serve <<END
$steel
  part: {shape: mesh, file: beam.h5, sites: {middle: {point: [500, 0, 10], normal: [0, 0, 1], curvatures: [0, 100], directions: [1, 0, 0]}}}
END
    ask beam 0.2 ".738 +- .004; 19.508e-3 N s +- .002e-3"
    ask beam 0.276 ".731 +- .01"
    ask beam 0.287 ".338 +- .01"
    ask beam 0.303 ".253 +- .01"
}

plate() {
    # shellcheck disable=SC2086
    reduce plate "Cylinder(1) = {0, 0, -10, 0, 0, 20, 100, Pi}; Mesh.MeshSizeMin = 6; Mesh.MeshSizeMax = 6;" $aluminium \
        --max-frequency 60000 --site 0,0,0
    serve <<END
$steel
  part: {shape: mesh, file: plate.h5, sites: {edge: {point: [0, 0, 0]}}}
END
    ask "half-circular plate" 0.3 ".9994 +- .0005"
}

cylinder() {
    # shellcheck disable=SC2086
    reduce cylinder "Cylinder(1) = {0, 0, 0, 73.68063, 0, 0, 36.840315}; Mesh.MeshSizeMin = 6; Mesh.MeshSizeMax = 6;" \
        $aluminium --max-frequency 60000 --site 73.68063,0,0
    serve <<END
$steel
  part: {shape: mesh, file: cylinder.h5, sites: {end: {point: [73.68063, 0, 0]}}}
END
    ask "compact cylinder" 0.3 ".9999; 161.4 us; 669 N"
}

# case, a body and its built-in twin, x of the place, velocity, coefficient: the impulses along both tangents
slide() {
    for body in $2 $3; do
        cat >request.json <<JSON
{"bodies": [{"id": "pebble", "position": [$4, 0, 0.016], "velocity": [$5]}, {"id": "$body"}],
 "contacts": [{"a": 0, "b": 1, "point": [$4, 0, 0.01], "normal": [0, 0, 1], "tangent": [1, 0, 0], "friction": $6}],
 "options": {"tolerance": 1e-5}}
JSON
        "$build/bin/percuss" query --local --catalogue oblique.yaml --request request.json --json 2>/dev/null |
            awk -v name="$1 $body" '/^ *"impulse_tangential": \[/ && !t { getline; t = $1 + 0; getline; t = t " " ($1 + 0) }
                END { gsub(",", "", name); print name ",,N s along and across," t }'
    done
}

# the sides of a short cylinder and of a bar, obliquely, beside those of Ritz's method
oblique() {
    # shellcheck disable=SC2086
    reduce short "$(bar 30 3)" $aluminium --site 11,0,10
    # shellcheck disable=SC2086
    reduce bar "$(bar 200 5)" $aluminium --modes 60 --site 62,0,10
    cat >oblique.yaml <<END
materials:
  steel:     {young: 210 GPa, poisson: 0.30, density: 7800, yield: none}
  aluminium: {young: 70 GPa, poisson: 0.33, density: 2700, yield: none}
bodies:
  pebble: {shape: sphere, material: steel, radius: 6 mm}
  short: {shape: mesh, file: short.h5}
  short-ritz: {shape: cylinder, material: aluminium, radius: 10 mm, length: 30 mm}
  bar: {shape: mesh, file: bar.h5}
  bar-ritz: {shape: cylinder, material: aluminium, radius: 10 mm, length: 200 mm}
  bar-beam: {shape: beam, material: aluminium, radius: 10 mm, length: 200 mm, ends: free}
END
    for flight in "0.1, 0, -0.28;0.3" "0, 0.21, -0.21;0.2" "0.1, 0.11, -0.26;0.5"; do
        slide "$flight" short short-ritz -0.004 "${flight%;*}" "${flight#*;}"
        slide "$flight" bar bar-ritz -0.038 "${flight%;*}" "${flight#*;}"
        slide "$flight" bar-beam "" -0.038 "${flight%;*}" "${flight#*;}"
    done
}

echo "case,speed,value,first_impulse,first_length_us,first_peak,others"
for part; do
    [ "$part" != rod-end ] || part=rod_end
    "$part"
done
