#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Everything built by a second compiler, warnings as errors, into build-clang/, and the unit tests of it.
# usage: clang.sh [ctest arguments]
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- -R '^(unit|cosim)/'

sh deploy/dependencies.sh ci || command -v clang >/dev/null
cmake -S . -B build-clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang
cmake --build build-clang --parallel "$(nproc)"
ctest --test-dir build-clang --output-on-failure --parallel 2 --timeout 300 "$@"
