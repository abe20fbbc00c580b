#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# What percuss-reduce takes, on bodies from compact to slender, beside CalculiX's frequencies of the same mesh where ccx
# is: a line of a table each. Times are of the processors (user), so that other work on the machine does not count, and
# seconds of the wall for the two stages; the reduction itself uses all processors for the sites.
# usage: reduction.sh BUILD [cube|plate|bar|strips|slender|part]...    (default: all)
set -eu
build=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- cube plate bar strips slender part
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export OMP_NUM_THREADS=1

# by Gmsh, in an Abaqus deck with the material: name, drawing
drawn() {
    printf 'SetFactory("OpenCASCADE");\nMesh.ElementOrder = 2;\nMesh.HighOrderOptimize = 2;\n%s\n' "$2" >"$1.geo"
    gmsh -3 -format inp -save_all -o "$1.mesh" "$1.geo" >"$1.log" 2>&1 || {
        cat "$1.log" >&2
        exit 1
    }
    # elements of the volume alone
    awk '/^\*/ { keep = !/ELEMENT/ || /C3D10/ }
        /^\*ELSET/ { exit }
        /^\*ELEMENT/ && keep { print "*ELEMENT, type=C3D10, ELSET=All"; next }
        keep { print }' "$1.mesh" >"$1.inp"
    material >>"$1.inp"
}

material() {
    printf '*MATERIAL, NAME=metal\n*ELASTIC\n210000, 0.3\n*DENSITY\n7.8e-9\n*SOLID SECTION, ELSET=All, MATERIAL=metal\n'
}

# bricks of 20 nodes: name, how many and how long (mm) each way
bricks() {
    awk -v nx="$2" -v ny="$3" -v nz="$4" -v lx="$5" -v ly="$6" -v lz="$7" '
        function node(i, j, k) {
            if (!((i, j, k) in number)) {
                number[i, j, k] = ++count
                lines[count] = count ", " i * lx / 2 / nx ", " j * ly / 2 / ny ", " k * lz / 2 / nz
            }
            return number[i, j, k]
        }
        BEGIN {
            split("0 2 2 0 0 2 2 0 1 2 1 0 1 2 1 0 0 2 2 0", x, " ")
            split("0 0 2 2 0 0 2 2 0 1 2 1 0 1 2 1 0 0 2 2", y, " ")
            split("0 0 0 0 2 2 2 2 0 0 0 0 2 2 2 2 1 1 1 1", z, " ")
            for (a = 0; a < nx; a++) for (b = 0; b < ny; b++) for (c = 0; c < nz; c++) {
                text = ++elements
                for (i = 1; i <= 20; i++)
                    text = text ", " (i == 16 ? "\n" : "") node(2 * a + x[i], 2 * b + y[i], 2 * c + z[i])
                deck[elements] = text
            }
            print "*NODE"
            for (i = 1; i <= count; i++) print lines[i]
            print "*ELEMENT, type=C3D20, ELSET=All"
            for (i = 1; i <= elements; i++) print deck[i]
        }' >"$1.inp"
    material >>"$1.inp"
}

# seconds of the processors that a command takes
user_seconds() {
    { command time -f %U "$@" >out.txt 2>err.txt; } || {
        cat err.txt >&2
        return 1
    }
    tail -n 1 err.txt
}

number() {
    sed -n "s/^ *\"$1\": *\([^,]*\),*$/\1/p" out.txt
}

# a line of the table: name, modes, aspect ratio of the elements
measure() {
    seconds=$(user_seconds "$build/bin/percuss-reduce" "$1.inp" --unit mm --modes "$2" --json -o "$1.h5")
    line=$(printf '%s %d %d %d %s %s %.3g %.3g %.3g %.3g %.1e' "$1" "$(number nodes)" "$(number elements)" \
        "$(number sites)" "$2" "$3" "$seconds" "$(number seconds_modes)" "$(number seconds_sites)" \
        "$(number seconds_expected)" "$(number force_imbalance)")
    theirs=-
    if command -v ccx >/dev/null; then
        { cat "$1.inp" && printf '*STEP\n*FREQUENCY\n%d\n*END STEP\n' "$(($2 + 6))"; } >"ccx-$1.inp"
        theirs=$(user_seconds ccx "ccx-$1")
    fi
    echo "$line $theirs"
}

echo "body nodes elements sites modes aspect user modes_s sites_s expected_s imbalance ccx_user"
for body; do
    case $body in
    cube)
        drawn cube 'Box(1) = {0, 0, 0, 20, 20, 20}; Mesh.MeshSizeMin = 5; Mesh.MeshSizeMax = 5;'
        measure cube 40 1
        ;;
    plate)
        drawn plate 'Box(1) = {0, 0, 0, 120, 120, 4}; Mesh.MeshSizeMin = 6; Mesh.MeshSizeMax = 6;'
        measure plate 60 1.5
        ;;
    bar)
        bricks bar 100 1 1 1000 10 10
        measure bar 10 1
        ;;
    strips)
        bricks strips 13 1 4 1000 10 10
        measure strips 1 31
        ;;
    slender)
        # the same bar, its elements a hundred times as long as they are wide
        bricks slender 1 1 2 1000 10 10
        measure slender 1 100
        ;;
    part)
        drawn part 'Box(1) = {0, 0, 0, 60, 60, 60}; Mesh.MeshSizeMin = 4.75; Mesh.MeshSizeMax = 4.75;'
        measure part 100 1
        ;;
    *)
        echo "reduction: $body: must be cube, plate, bar, strips, slender or part" >&2
        exit 2
        ;;
    esac
done
