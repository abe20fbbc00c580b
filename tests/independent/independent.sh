#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0

# Runs a program of this folder in the virtual environment of the Python tests, on the library in the build tree.
# usage: independent.sh PROGRAM [ARGUMENT]... (--weekly: other scenes each week), with PERCUSS_SOURCE, PERCUSS_VENV, PERCUSS_LIBRARY;
# exit code 77, with the reason: there is nothing to test with.
set -eu
[ -e "$PERCUSS_VENV/wanted" ] || {
    echo "skipped: no virtual environment; see the test python/environment" >&2
    exit 77
}
program=$1
shift
if [ "${1:-}" = --weekly ]; then
    seed=$(date +%G%V)
    echo "the same scenes again: --draw $seed --count 16"
    set -- --draw "$seed" --count 16
fi
exec env OPENBLAS_NUM_THREADS=1 "$PERCUSS_VENV/bin/python" "$PERCUSS_SOURCE/tests/independent/$program" "$@"
