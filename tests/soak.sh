#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Mixed traffic with reloads (tests/service/faults/mixed_traffic.sh) against a daemon, with clients, all under
# sanitizers: address and undefined behaviour, then thread, each for that long; an hour without arguments.
# usage: soak.sh [SECONDS [address|thread...]]
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-3600}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- address thread

sh deploy/dependencies.sh test
for which in "$@"; do
    echo "soak: $which, $seconds s"
    cmake --preset "$which" >/dev/null
    cmake --build "build-$which" --parallel "$(nproc)" --target percussd percuss wire_damaged >/dev/null
    # Cyclone DDS itself is not instrumented
    TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp" PERCUSS_SOAK=$seconds PERCUSS_SOAK_PATIENCE=120 \
        PERCUSS_BUILD=$PWD/build-$which PERCUSS_SOURCE=$PWD sh tests/service/faults/mixed_traffic.sh
done
