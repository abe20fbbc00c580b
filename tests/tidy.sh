#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The sources by clang-tidy, with the checks of .clang-tidy as errors, into build-tidy/. Takes two minutes.
# usage: tidy.sh [FOLDER...]    default: service client idl
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- service client idl
command -v clang-tidy >/dev/null || {
    echo "tidy: NOT TRIED: clang-tidy is not installed" >&2
    exit 77
}
cmake -S . -B build-tidy -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
cmake --build build-tidy --target wire_types_generate ros_types_generate >/dev/null
# those that are compiled, some at a time
compiled=$(sed -n "s|.*\"file\": \"$PWD/\(.*\.c\)\".*|\1|p" build-tidy/compile_commands.json | sort -u)
files=$(for folder in "$@"; do echo "$compiled" | grep "^${folder%/}/"; done)
echo "$files" | xargs -P "$(nproc)" -n 8 clang-tidy -p build-tidy --quiet
echo "tidy: $(echo "$files" | wc -l) files"
