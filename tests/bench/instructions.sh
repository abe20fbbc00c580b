#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Counts the instructions of warm solves and compares them with the recorded ones: more than 10 %
# above them fails.
# A sample of an ensemble is told beside them, and a blow at a place that nothing is kept of.
# usage: instructions.sh [--record] PROGRAM [OFTEN]    (build/tests/bench/solve_once, solve_often)
#
# What is counted is the work of this project's own code: callgrind books instructions by the object
# file they are in, and only those of the program itself count, which holds the static libraries.
# libm and libc choose variants by the processor, so of them only the number of calls counts. The
# program is built with PERCUSS_ONE_KERNEL, without AVX2 clones. The same compiler then gives the same
# counts on every x86-64.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
recorded=$here/instructions.txt

record=no
if [ "${1:-}" = --record ]; then
    record=yes
    shift
fi
[ $# -eq 1 ] || [ $# -eq 2 ] || {
    echo "usage: instructions.sh [--record] PROGRAM [OFTEN]" >&2
    exit 2
}
program=$1
often=${2:-}
command -v valgrind >/dev/null || {
    echo "instructions: valgrind is not installed (Debian: apt-get install valgrind): not counted" >&2
    exit 77
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# warm solves: instructions within the program, and calls from it into shared libraries
count() {
    if ! valgrind --tool=callgrind \
        --toggle-collect='counted_*' --callgrind-out-file="$work/out" --compress-strings=no \
        "$program" "$@" >"$work/log" 2>&1; then
        cat "$work/log" >&2
        return 1
    fi
    # self cost; the line after calls= is a callee's inclusive cost
    awk -v own="$(basename "$program")" '
        /^ob=/ { n = split($0, part, "/"); mine = (part[n] == own) }
        /^cob=/ { n = split($0, part, "/"); away = (part[n] != own); next }
        /^calls=/ { if (mine && away) { split($1, call, "="); calls += call[2] }
                    away = 0; skip = 1; next }
        /^(\+|-|\*|[0-9])/ { if (skip) skip = 0; else if (mine) sum += $2 }
        END { printf "%d %d\n", sum, calls }' "$work/out"
}

# compare SCENE TOLERANCE COLUMN COUNT
compare() {
    what=instructions
    [ "$3" -eq 3 ] || what="library calls"
    before=$(awk -v s="$1" -v t="$2" -v c="$3" '$1 == s && $2 == t { print $c }' "$recorded")
    echo "$1 $2: $4 $what, recorded ${before:-none}"
    if [ "$4" -le 0 ] || [ -z "$before" ]; then
        echo "instructions: $1 at $2: nothing counted or nothing recorded (--record)" >&2
        return 1
    fi
    [ "$(($4 * 10))" -le "$((before * 11))" ] && return 0
    echo "instructions: $1 at $2: $4 $what, more than 10 % above the recorded $before" >&2
    return 1
}

: >"$work/counts"
bad=0
for scene in rod beam; do
    for tolerance in 1e-3 1e-4; do
        counted=$(count "$scene" "$tolerance")
        echo "$scene $tolerance $counted" >>"$work/counts"
        [ "$record" = no ] || continue
        for column in 3 4; do
            now=$(echo "$scene $tolerance $counted" | cut -d ' ' -f "$column")
            compare "$scene" "$tolerance" "$column" "$now" || bad=1
        done
    done
done
# a throw with friction, between the tangents
thrown=$(count beam 1e-3 thrown)
echo "thrown 1e-3 $thrown" >>"$work/counts"
[ "$record" = yes ] || compare thrown 1e-3 3 "${thrown% *}" || bad=1
samples=$(count beam 1e-3 samples | cut -d ' ' -f 1)
echo "a sample of an ensemble on the beam at 1e-3: $((samples / 100)) instructions"
fresh=$(count beam 1e-3 sites | cut -d ' ' -f 1)
again=$(count beam 1e-3 sites-again | cut -d ' ' -f 1)
echo "a blow on the beam at 1e-3 where none was before: $((fresh / 100)) instructions, there again: $((again / 100))"
# three contacts at once against one: thirty groups on a beam and their ninety contacts one by one. The aim is
# 400 %; what a group costs itself is held, for the share rises when a single contact becomes cheaper.
if [ -n "$often" ]; then
    program=$often
    groups=$(count beam 1e-3 groups)
    singles=$(count beam 1e-3 singles | cut -d ' ' -f 1)
    total=${groups% *}
    echo "groups 1e-3 $groups" >>"$work/counts"
    [ "$record" = yes ] || compare groups 1e-3 3 "$total" || bad=1
    echo "a group of three contacts: $((300 * total / singles)) % of the instructions of one contact"
fi
if [ "$record" = yes ]; then
    {
        echo "# instructions of warm solves: scene, tolerance, instructions, library calls (instructions.sh --record)"
        cat "$work/counts"
    } >"$recorded"
    cat "$recorded"
fi
exit $bad
