#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# What a warm solve costs on a bar's mesh against the built-in bar, in instructions: with 160 modes of
# each family, and with as many of them as a tolerance of 1e-3 asks for. The impact itself costs the same,
# to the instruction; more than a twentieth above the rod and what it takes to find a place on a mesh fails.
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

count() { # count PROGRAM SCENE bar|mesh MODES [free]
    valgrind --tool=callgrind --instr-atstart=no --toggle-collect=counted_solve --callgrind-out-file="$work/out" \
        "$@" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        return 1
    }
    sed -n 's/^summary: *\([0-9]*\).*/\1/p' "$work/out"
}

bad=0
# of a place: some 15,000 for the faces about it, and to tell which modes take part there
place=30000

compare() { # compare SCENE PERCENT [free]
    scene=$1
    percent=$2
    shift 2
    bar=$(count "$program" "$scene" bar 160 "$@")
    mesh=$(count "$program" "$scene" mesh 160 "$@")
    echo "$scene $*: bar $bar, mesh $mesh instructions, ratio $(awk -v b="$bar" -v m="$mesh" \
        'BEGIN { printf "%.3f", m / b }')"
    [ "${bar:-0}" -gt 10000 ] && [ "${mesh:-0}" -gt 10000 ] || {
        echo "mesh_cost: nothing counted" >&2
        bad=1
    }
    [ $((100 * (mesh - place))) -le $((percent * bar)) ] || {
        echo "mesh_cost: a mesh of the $scene costs more than $percent % of the built-in one and $place" >&2
        bad=1
    }
}
program=$1
compare rod 105
compare rod 105 free
# a mesh of the beam is asked for more solutions beside the answer, whose amplitudes of all modes are compared:
# counted are 177 and 174 % at this speed
compare beam 180
compare beam 180 free
exit $bad
