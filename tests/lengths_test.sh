#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Mirrors lengths.sh: what is just short enough passes, one line more is refused and named.
# usage: lengths_test.sh
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/service" "$work/client" "$work/idl" "$work/tests"

# function LINES: of so many with a head of two, behind a declaration that is none of it
function() {
    printf 'static int other;\nstatic int\nlong_one(void)\n{\n'
    yes '    other++;' | head -n $(($1 - 4))
    printf '}\n'
}

# file LINES FUNCTION: with blank lines behind a function of so many
file() {
    function "$2" >"$work/service/made_up.c"
    yes '' | head -n $(($1 - $2 - 1)) >>"$work/service/made_up.c"
}

check() {
    sh "$here/lengths.sh" "$work" >"$work/said" 2>&1
}

# refused WORDS
refused() {
    ! check || { echo "passes: $1" >&2 && exit 1; }
    grep -qF "$1" "$work/said" || { cat "$work/said" >&2 && exit 1; }
}

file 1000 60
check || { cat "$work/said" >&2 && exit 1; }
file 1001 60
refused "service/made_up.c: 1001 lines"
file 1000 61
refused "service/made_up.c:2: 61 lines: at most 60 are allowed: static int"
: >"$work/service/made_up.c"
refused "no function was found"
echo "lengths_test: passed"
