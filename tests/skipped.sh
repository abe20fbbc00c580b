#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Names the tests that ctest skipped and the cases that a test program skipped by itself; fails if there
# are any, or no tests at all.
# usage: skipped.sh REPORT    (of ctest --output-junit with the whole output of passed tests)
set -eu
[ $# -eq 1 ] || {
    echo "usage: skipped.sh REPORT" >&2
    exit 2
}
# cmocka: [  SKIPPED ] name; unittest: OK (skipped=2)
awk '
    /<testcase name=/ {
        name = $0
        sub(/.*<testcase name="/, "", name)
        sub(/".*/, "", name)
        tests++
        said = /status="(run|fail)"/
    }
    /<testcase name=/ && !said { said = 1; skipped++; print "SKIPPED: " name }
    !whole[name] && (/\[  SKIPPED \]/ || /(^|>)OK \(.*skipped=/) {
        whole[name] = 1
        skipped++
        print "SKIPPED: cases of " name
    }
    END {
        if (!tests) print "skipped: no tests in the report"
        exit !tests || skipped > 0
    }' "$1" >&2
