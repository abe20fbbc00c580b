#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
#
# One ensemble, and single questions, by 1 to 16 workers: threads, MPI's processes, Dask's, daemons; and a simulation
# of 1,000. Writes the tables of docs/lab/workers.md between its marks. Some five minutes.
# usage: workers.sh BUILD [PAGE]      a Release build with percuss-ensemble (sh deploy/dependencies.sh mpi) and tests;
#                                     needs python3-venv and a package index
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
build=$(cd "${1:?usage: workers.sh BUILD [PAGE]}" && pwd)
page=${2:-$source/docs/lab/workers.md}
[ -x "$build/bin/percuss-ensemble" ] || {
    echo "workers: percuss-ensemble was not built: sh deploy/dependencies.sh mpi" >&2
    exit 1
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check numpy==2.4.6 distributed==2026.8.0 dask==2026.8.0

export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
PERCUSS_LIBRARY=$build/client/libpercuss.so PYTHONPATH=$source/client/python \
    "$work/venv/bin/python" "$here/workers.py" "$source" "$build" "$work" >"$work/tables"
sh "$here/tables.sh" "$page" "$work/tables"
cat "$work/tables"
