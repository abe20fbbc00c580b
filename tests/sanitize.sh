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
# Reports go to files: a story may expect the status that a report ends with, or kill what has made one. Those of
# undefined behaviour stay on standard error, whatever log_path says: they end with a status that no story expects.
# Cyclone DDS and HDF5 themselves are not instrumented; impossible sizes are asked for, to be refused
reports=$PWD/build-$which/reports
rm -rf "$reports"
mkdir "$reports"
to="log_path=$reports/report log_exe_name=1"
code=0
TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp allocator_may_return_null=1 $to" \
    LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp print_suppressions=0" \
    ASAN_OPTIONS="$to" UBSAN_OPTIONS="print_stacktrace=1 exitcode=99" \
    ctest --test-dir "build-$which" --output-on-failure --parallel 2 --timeout 900 "$@" || code=$?
for report in "$reports"/*; do
    [ -e "$report" ] || continue
    echo "sanitize: $report" >&2
    cat "$report" >&2
    code=1
done
exit "$code"
