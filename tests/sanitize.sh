#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests under sanitizers (address with undefined behaviour, or thread), each in a build directory of its own.
# All of them take hours; `sanitize.sh address -R ^unit/` are those of the sources, a quarter of an hour.
# usage: sanitize.sh [address|thread] [ctest arguments]
set -eu
cd "$(dirname "$0")/.."
which=${1:-address}
[ $# -eq 0 ] || shift

sh deploy/dependencies.sh test
cmake --preset "$which"
cmake --build "build-$which" --parallel "$(nproc)"
# Cyclone DDS and HDF5 themselves are not instrumented; impossible sizes are asked for, to be refused
TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp allocator_may_return_null=1" \
    LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp print_suppressions=0" \
    ctest --test-dir "build-$which" --output-on-failure --parallel 2 --timeout 900 "$@"
