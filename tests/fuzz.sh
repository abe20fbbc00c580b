#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# libFuzzer on the readers of foreign input and on the solver, under address and undefined-behaviour
# sanitizers, in build-fuzz/. What is found lies in build-fuzz/findings; to be kept in tests/fuzz/corpus
# once it is mended. New inputs are kept in build-fuzz/inputs from run to run.
# usage: fuzz.sh [SECONDS [HARNESS...]]    of each harness, 5 by default; all of them
# PERCUSS_FUZZ_SEED=N: the first 20000 inputs that N gives, or those of SECONDS if they are fewer: on each machine the
# same, so that what passes with more seconds passes with less; without it others in each run
# PERCUSS_FUZZ_JOBS=N: so many harnesses side by side, 1 by default
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-5}
[ $# -eq 0 ] || shift

sh deploy/dependencies.sh ci || command -v clang >/dev/null
cmake -S . -B build-fuzz -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang -DPERCUSS_FUZZ=ON \
    -DPERCUSS_SANITIZE=fuzzer-no-link,address,undefined >/dev/null
cmake --build build-fuzz --parallel "$(nproc)" --target fuzzers >/dev/null
[ $# -gt 0 ] || set -- $(cd tests/fuzz && sed -n 's/^percuss_fuzz(\([a-z_0-9]*\) .*/\1/p' CMakeLists.txt)

# no memory is an answer that callers handle; what counts is the memory that is touched
export ASAN_OPTIONS=allocator_may_return_null=1
root=$PWD
mkdir -p build-fuzz/findings build-fuzz/empty
# an input that names files finds none
cd build-fuzz/empty

# libFuzzer compares addresses, too: where they differ from run to run, so do its inputs
same=
if setarch -R true 2>/dev/null; then same='setarch -R'; fi

# try HARNESS: false if it found something
try() {
    inputs=$root/build-fuzz/inputs/$1
    most=-1
    if [ -n "${PERCUSS_FUZZ_SEED:-}" ]; then
        inputs=$root/build-fuzz/seeded/$1
        most=20000
        rm -rf "$inputs"
    fi
    log=$root/build-fuzz/$1.log
    mkdir -p "$inputs"
    # the solver works for up to a second and a half, longer under sanitizers; readers for an instant
    case $1 in solve) patience=60 ;; *) patience=20 ;; esac
    # in one order everywhere
    seeds=$(while read -r seed; do
        if [ -d "$seed" ]; then ls -d "$seed"/*; else echo "$seed"; fi
    done <"$root/build-fuzz/tests/fuzz/$1.seeds" | LC_ALL=C sort | paste -sd ,)
    code=0
    $same "$root/build-fuzz/tests/fuzz/fuzz_$1" "$inputs" -seed_inputs="$seeds" -reload=0 \
        -max_total_time="$seconds" -runs="$most" -seed="${PERCUSS_FUZZ_SEED:-0}" \
        -timeout="$patience" -rss_limit_mb=3000 -malloc_limit_mb=100000 -print_final_stats=1 \
        -artifact_prefix="$root/build-fuzz/findings/$1-" >/dev/null 2>"$log" &
    fuzzer=$!
    trap 'kill "$fuzzer"; exit 1' TERM
    wait "$fuzzer" || code=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    cover=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
    if [ "$code" -eq 0 ]; then
        echo "fuzz: $1: $runs runs, $cover edges reached"
        return
    fi
    echo "fuzz: $1: found something after $runs runs:"
    grep -a -v '^#\|^INFO\|^stat::\|NEW_FUNC\|^\\|BuildId: .*fuzz_\|libFuzzer has\|Combine lib' "$log" |
        cut -c 1-300 | tail -n 40
    return 1
}

# those side by side begin and end together
bad=0
side_by_side=
trap 'kill $side_by_side 2>/dev/null; exit 1' INT TERM
while [ $# -gt 0 ]; do
    side_by_side=
    for job in $(seq "${PERCUSS_FUZZ_JOBS:-1}"); do
        [ $# -gt 0 ] || break
        try "$1" &
        side_by_side="$side_by_side $!"
        shift
    done
    for job in $side_by_side; do
        wait "$job" || bad=1
    done
done
exit "$bad"
