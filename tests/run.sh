#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs what is missing, builds everything into build/ and runs every test.
set -eu
cd "$(dirname "$0")/.."

sh deploy/dependencies.sh test
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release
cmake --build build --parallel "$(nproc)"
# server tests take random domains; two at a time, as the machine has two cores
ctest --test-dir build --output-on-failure --parallel 2 --timeout 300
