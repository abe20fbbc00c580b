#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# Bodies in three dimensions by modes, by complete finite elements and by CalculiX, and models A and C at equal
# error: the figures and tables of docs/lab/peers.md. Some eight minutes of one core.
# usage: solids.sh [BUILD [OUTPUT [PYTHON]]]      build, docs/figures, and a Python with numpy and scipy
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../../.." && pwd)
build=$(cd "${1:-$source/build}" && pwd)
output=$(cd "${2:-$source/docs/figures}" && pwd)
python=${3:-python3}

results=$(mktemp)
trap 'rm -f "$results"' EXIT
echo "solids: by percuss, complete finite elements and CalculiX: some eight minutes"
echo "scene,program,settings,error,seconds,why" >"$results"
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PERCUSS_LIBRARY="$build/client/libpercuss.so" PYTHONPATH="$source/client/python" \
    "$python" "$here/solids.py" "$build" "$results"
cat "$results" >"$output/solids.csv"
"$python" "$here/table.py" "$output/solids.csv" "$source/docs/lab/peers.md" solids
