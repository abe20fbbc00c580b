#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# What a warm solve with 160 modes of each family costs on a bar's mesh against the built-in bar, in
# instructions: more than a tenth above it fails. Finding the place on the mesh is what is left.
# usage: mesh_cost.sh PROGRAM    (build/tests/bench/mesh_once)
set -eu
[ $# -eq 1 ] || {
    echo "usage: mesh_cost.sh PROGRAM" >&2
    exit 2
}
command -v valgrind >/dev/null || {
    echo "mesh_cost: valgrind is not installed (Debian: apt-get install valgrind): not counted" >&2
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() { # count PROGRAM SCENE bar|mesh MODES
    valgrind --tool=callgrind --toggle-collect=counted_solve --callgrind-out-file="$work/out" \
        "$@" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        return 1
    }
    sed -n 's/^summary: *\([0-9]*\).*/\1/p' "$work/out"
}

bad=0
for scene in rod beam; do
    bar=$(count "$1" "$scene" bar 160)
    mesh=$(count "$1" "$scene" mesh 160)
    echo "$scene: bar $bar, mesh $mesh instructions, ratio $(awk -v b="$bar" -v m="$mesh" \
        'BEGIN { printf "%.3f", m / b }')"
    [ "${bar:-0}" -gt 10000 ] && [ "${mesh:-0}" -gt 10000 ] || {
        echo "mesh_cost: nothing counted" >&2
        bad=1
    }
    [ $((20 * mesh)) -le $((22 * bar)) ] || {
        echo "mesh_cost: a mesh of the $scene costs more than a tenth above the built-in one" >&2
        bad=1
    }
done
exit $bad
