#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# All harnesses of tests/fuzz in turn, over and over, until together they have had so many inputs or one of them
# has found something: for a night. As many run side by side as there are processors. Says how far it is after each
# round, and the sums of each harness at the end, also when it is interrupted.
# usage: nightly_fuzz.sh [INPUTS [SECONDS [HARNESS...]]]    100000000 by default; of each harness in a round, 300
set -eu
cd "$(dirname "$0")/.."
wanted=${1:-100000000}
seconds=${2:-300}
[ $# -lt 2 ] && set -- || shift 2
folder=build-fuzz/night
rm -rf "$folder"
mkdir -p "$folder"
: >"$folder/lines"
begun=$(date +%s)

# "HARNESS RUNS" of all rounds
sums() {
    awk '/ runs/ { name = $2; sub(":", "", name); for (i = 3; i <= NF; i++) if ($i ~ /^runs/) runs[name] += $(i - 1) }
        END { for (name in runs) printf "%s %d\n", name, runs[name] }' "$folder/lines" | sort
}
total() {
    sums | awk '{ sum += $2 } END { printf "%d\n", sum }'
}
report() {
    trap - EXIT
    sums | while read -r harness runs; do
        echo "nightly fuzz: $harness: $runs"
    done
    took=$(($(date +%s) - begun))
    echo "nightly fuzz: $(total) inputs of $wanted in $took s, $(($(total) / (took > 0 ? took : 1))) a second"
}
round=
trap report EXIT
trap 'kill $round 2>/dev/null; exit 1' INT TERM

while [ "$(total)" -lt "$wanted" ]; do
    code=0
    PERCUSS_FUZZ_JOBS=$(nproc) sh tests/fuzz.sh "$seconds" "$@" >"$folder/round" 2>&1 &
    round=$!
    wait "$round" || code=$?
    cat "$folder/round" >>"$folder/lines"
    grep -q ' runs' "$folder/round" && [ "$code" -eq 0 ] || {
        cat "$folder/round"
        exit 1
    }
    echo "nightly fuzz: $(($(date +%s) - begun)) s: $(total) of $wanted inputs"
done
