#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The benchmark of the service runs and prints what is promised of it; no times are judged.
# usage: round_trip.sh PROGRAM
set -eu
program=$1
out=$(mktemp)
trap 'rm -f "$out"' EXIT

fail() {
    echo "FAILED: $*" >&2
    cat "$out" >&2
    exit 1
}

# table HEADER SCENES FIRST LAST: the header, then lines of these scenes whose fields FIRST to LAST are > 0
table() {
    [ "$(head -n 1 "$out")" = "$1" ] || fail "the header is not $1"
    [ "$(sed 1d "$out" | cut -d, -f1 | uniq | paste -sd' ' -)" = "$2" ] || fail "scenes: not $2"
    sed 1d "$out" | awk -F, -v first="$3" -v last="$4" -v fields="$(echo "$1" | tr , '\n' | wc -l)" '
        NF != fields { exit 1 }
        { for (i = first; i <= last; i++) if (!($i > 0)) exit 1 }
        $1 == "ping" && !($2 <= $3 && $4 <= $5) { exit 1 }' || fail "a line is not as it should be"
}

timeout 120 "$program" --csv --trips 20 >"$out"
table scene,raw_p50,raw_p99,service_p50,service_p99 \
    "ping sphere-sphere rod-1e-4 beam-1e-3 beam-1e-4" 2 5

timeout 120 "$program" --csv --throughput --scene beam-1e-3 --trips 40 --batch 8 --clients 2 \
    --outstanding 4 >"$out"
table scene,mode,clients,outstanding,requests_per_second,p50,p99,service_cpu,busy beam-1e-3 3 8
grep -q '^beam-1e-3,batch,1,8,' "$out" || fail "no line of batches"
grep -q '^beam-1e-3,pipeline,2,4,' "$out" || fail "no line of clients at once"

timeout 120 "$program" --trips 20 --scene ping >"$out"
grep -q '^ping ' "$out" || fail "no table for people"
"$program" --help >"$out"
grep -q -- --throughput "$out" || fail "no help"
code=0
"$program" --scene nothing 2>"$out" || code=$?
[ "$code" -eq 2 ] || fail "an unknown scene ends with $code, not 2"
echo "round_trip prints what it promises"
