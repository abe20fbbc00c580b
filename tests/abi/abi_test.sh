#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Mirrors abi.sh: a struct that grew, a member that moved, an enumerator or a prototype that changed is refused by name,
# and recording does not hide it; new ones are asked to be recorded.
# usage: abi_test.sh SOURCE_DIR
set -eu
here=$(cd "$(dirname "$0")" && pwd)
command -v pahole >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/client/include/percuss" "$work/idl"
export PERCUSS_ABI_RECORDS="$work"
header=$work/client/include/percuss/made_up.h

# interface MEMBERS ENUMERATORS PARAMETERS [MORE]
interface() {
    printf '#define PERCUSS_API\nstruct percuss_made_up {%s};\nenum percuss_kind {%s};\n%s\n' "$1" "$2" "${4:-}" \
        >"$header"
    printf '/* a comment */\nPERCUSS_API int percuss_made_up(%s);\n' "$3" >>"$header"
}

check() {
    sh "$here/abi.sh" "$work" 7 "$@" >"$work/said" 2>&1
}

# refused WORDS, recorded or not
refused() {
    for record in "" --record; do
        ! check $record || { echo "abi_test: passes: $1" >&2 && exit 1; }
        grep -qF "$1" "$work/said" || { cat "$work/said" >&2 && exit 1; }
    done
}

interface "int a; double b;" "PERCUSS_A, PERCUSS_B" "int a"
! check || { echo "abi_test: nothing is recorded, and it passes" >&2 && exit 1; }
check --record && check || { cat "$work/said" >&2 && exit 1; }
interface "int a; double b; int c;" "PERCUSS_A, PERCUSS_B" "int a"
refused "size    percuss_made_up 16"
interface "double b; int a;" "PERCUSS_A, PERCUSS_B" "int a"
refused "member  percuss_made_up: int a at 0 4"
interface "int a; double b;" "PERCUSS_B, PERCUSS_A" "int a"
refused "value   PERCUSS_B 1"
interface "int a; double b;" "PERCUSS_A, PERCUSS_B" "long a"
refused "call    int percuss_made_up(int a);"
interface "int a; double b;" "PERCUSS_A, PERCUSS_B, PERCUSS_C" "int a" "struct percuss_more { int a; };"
! check || { echo "abi_test: new lines pass unrecorded" >&2 && exit 1; }
grep -qF "value   PERCUSS_C 2" "$work/said" || { cat "$work/said" >&2 && exit 1; }
check --record && check || { cat "$work/said" >&2 && exit 1; }
# this project's headers are found, and the smallest change of them too
cp "$1"/client/include/percuss/*.h "$work/client/include/percuss"
cp -r "$1/idl/percuss" "$work/idl"
cp "$here"/*.txt "$work"
rm "$header"
sed -i 's/double restitution;/float restitution;/' "$work/client/include/percuss/reply.h"
number=$(basename "$(ls "$here"/*.txt | tail -n 1)" .txt)
! sh "$here/abi.sh" "$work" "$number" >"$work/said" 2>&1 || { echo "abi_test: a changed reply passes" >&2 && exit 1; }
grep -qF "double restitution at" "$work/said" || { cat "$work/said" >&2 && exit 1; }
echo "abi_test: passed"
