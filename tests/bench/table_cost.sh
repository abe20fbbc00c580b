#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# What a solve with a contact table costs against one with Hertz's law at the same tolerance, in
# instructions: more than 1.5 times fails.
# usage: table_cost.sh PROGRAM CONFIG_FOLDER    (build/tests/bench/table_once config)
set -eu
[ $# -eq 2 ] || {
    echo "usage: table_cost.sh PROGRAM CONFIG_FOLDER" >&2
    exit 2
}
command -v valgrind >/dev/null || {
    echo "table_cost: valgrind is not installed (Debian: apt-get install valgrind): not counted" >&2
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() { # count PROGRAM CONFIG_FOLDER MODEL TOLERANCE
    valgrind --tool=callgrind --instr-atstart=no --toggle-collect=counted_solve --callgrind-out-file="$work/out" \
        "$@" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        return 1
    }
    sed -n 's/^summary: *\([0-9]*\).*/\1/p' "$work/out"
}

bad=0
for tolerance in 1e-3 1e-4 1e-5 1e-6; do
    hertz=$(count "$1" "$2" hertz "$tolerance")
    table=$(count "$1" "$2" table "$tolerance")
    echo "$tolerance: hertz $hertz, table $table instructions, ratio $(awk -v h="$hertz" -v t="$table" \
        'BEGIN { printf "%.2f", t / h }')"
    [ "${hertz:-0}" -gt 10000 ] && [ "${table:-0}" -gt 10000 ] || {
        echo "table_cost: nothing counted" >&2
        bad=1
    }
    [ $((10 * table)) -le $((15 * hertz)) ] || {
        echo "table_cost: more than 1.5 times Hertz at $tolerance" >&2
        bad=1
    }
done
exit $bad
