#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-reduce-mpi makes the same body on one process and on four as percuss-reduce does.
. "$(dirname "$0")/lib.sh"
. "$here/block_deck.sh"
if [ ! -x "$bin/percuss-reduce-mpi" ] || ! command -v mpirun >/dev/null; then
    say "MUMPS for MPI (Debian: libmumps-dev, libopenmpi-dev, openmpi-bin) is not installed: skipped"
    exit 77
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1

block 12 4 3 >"$work/block.inp"
options="$work/block.inp --unit mm --young 210e9 --poisson 0.3 --density 7800 --modes 20 --json"

say "alone, and under MPI"
expect 0 "$bin/percuss-reduce" $options -o "$work/alone.h5"
mv "$out" "$work/alone.json"
for ranks in 1 4; do
    expect 0 mpirun --oversubscribe -n $ranks "$bin/percuss-reduce-mpi" $options -o "$work/mpi.h5"
    [ "$(field hash)" = "$(field hash "$work/alone.json")" ] || fail "another body on $ranks"
    # factors differ in rounding
    grep -h '"frequencies"' "$work/alone.json" "$out" | tr -d '[],' | awk '
        NR == 1 { split($0, one, " ") }
        NR == 2 { for (i = 2; i <= NF; i++) if (($i / one[i] - 1) ^ 2 > 1e-22) bad = 1; if (NF != 21) bad = 1 }
        END { exit bad || NR != 2 }' || fail "other frequencies on $ranks"
done

say "every process ends when the first does"
expect 2 timeout 60 mpirun --oversubscribe -n 2 "$bin/percuss-reduce-mpi"
expect 1 timeout 60 mpirun --oversubscribe -n 2 "$bin/percuss-reduce-mpi" "$work/none.inp" -o "$work/none.h5"
says 'none.inp'
