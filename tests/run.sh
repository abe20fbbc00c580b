#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what is missing, builds everything into build/ and runs every test. With CI=true a skipped test
# is a failure, clang builds everything too, every reader is fuzzed for some seconds, and on an empty machine
# README is followed and the packages are installed (tests/fresh.sh runs this suite on one, too).
# PERCUSS_NO_SKIPS=true: skipped tests are failures, and that is all.
set -eu
cd "$(dirname "$0")/.."
ci=${CI:-false}
[ "$ci" = true ] && no_skips=true || no_skips=${PERCUSS_NO_SKIPS:-false}

[ "$ci" = true ] && packages=ci || packages=test
sh deploy/dependencies.sh "$packages"
# deploy/quickstart.sh builds without tests
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON
cmake --build build --parallel "$(nproc)"
# server tests take random domains; one more at a time than there are processors, as half of them mostly wait
report=$PWD/build/tests.xml
rm -f "$report"
ctest --test-dir build --output-on-failure --parallel $(($(nproc) + 1)) --timeout 300 --output-junit "$report" \
    --test-output-size-passed 1000000
sh tests/skipped.sh "$report" || [ "$no_skips" != true ]

[ "$ci" = true ] || exit 0
sh tests/clang.sh
# inputs that a seed gives, so that a change is judged by what it changed; new ones: sh tests/fuzz.sh 60
PERCUSS_FUZZ_SEED=1 PERCUSS_FUZZ_JOBS=$(nproc) sh tests/fuzz.sh 5
# what this machine does not allow is said, and no failure
code=0
sh tests/fresh.sh quickstart packages || code=$?
[ "$code" -eq 0 ] || [ "$code" -eq 77 ]
