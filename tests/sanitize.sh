#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# The tests under sanitizers, each in a build directory of its own. Slower than tests/run.sh.
# usage: sanitize.sh [address|thread] [ctest arguments]
set -eu
cd "$(dirname "$0")/.."
which=${1:-address}
[ $# -eq 0 ] || shift

sh deploy/dependencies.sh test
cmake --preset "$which"
cmake --build "build-$which" --parallel "$(nproc)"
# Cyclone DDS itself is not instrumented
TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp" \
    ctest --test-dir "build-$which" --output-on-failure --parallel 2 --timeout 900 "$@"
