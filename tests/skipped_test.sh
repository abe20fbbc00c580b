#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Mirrors skipped.sh: every way to skip is named and makes it fail; tests that pass do not.
# usage: skipped_test.sh CTEST
set -eu
ctest=${1:?"usage: skipped_test.sh CTEST"}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# a_test NAME COMMAND: what the shell runs
a_test() {
    printf 'add_test(%s sh -c [=[%s]=])\nset_tests_properties(%s PROPERTIES SKIP_RETURN_CODE 77)\n' \
        "$1" "$2" "$1" >>"$work/CTestTestfile.cmake"
}

# report: by ctest as tests/run.sh calls it
report() {
    "$ctest" --test-dir "$work" --output-junit "$work/tests.xml" \
        --test-output-size-passed 1000000 >"$work/log"
    sh "$here/skipped.sh" "$work/tests.xml" 2>"$work/said"
}

: >"$work/CTestTestfile.cmake"
! report || { echo "an empty report passes" >&2 && exit 1; }
a_test passes 'echo "nothing is skipped here"'
report || { cat "$work/said" >&2 && exit 1; }

a_test has_no_network 'exit 77'
# beyond the part of an output that ctest keeps by itself
a_test leaves_out_a_case 'seq 1 2000; echo "[  SKIPPED ] memory_is_counted"; echo "[  SKIPPED ] 1 test(s)."'
a_test has_no_numpy 'echo "OK (skipped=2)"'
! report || { echo "skipped tests pass" >&2 && exit 1; }
printf 'SKIPPED: %s\n' has_no_network "cases of leaves_out_a_case" "cases of has_no_numpy" |
    sort >"$work/expected"
sort "$work/said" | diff "$work/expected" - || exit 1
echo "skipped_test: passed"
