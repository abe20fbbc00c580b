#!/bin/sh
# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
# percuss-reduce-mpi makes the same body on one process and on four as percuss-reduce does.
. "$(dirname "$0")/../support/lib.sh"
. "$support/block_deck.sh"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1

steel="--unit mm --young 210e9 --poisson 0.3 --density 7800 --json"

same() { # same DECK RANKS OPTION...: the body of percuss-reduce
    deck="$work/$1" ranks=$2
    shift 2
    expect 0 "$bin/percuss-reduce" "$deck" $steel "$@" -o "$work/alone.h5"
    alone=$(field hash) confirmed=$(field confirmed)
    for number in $ranks; do
        expect 0 mpirun --oversubscribe -n "$number" "$bin/percuss-reduce-mpi" "$deck" $steel "$@" -o "$work/mpi.h5"
        [ "$(field hash)" = "$alone" ] || fail "another body on $number"
        [ "$(field confirmed)" = "$confirmed" ] || fail "$(field confirmed) modes by inertia, not $confirmed"
        # rounding of other factors and other bases: 1e-14 and 2e-11 here
        expect 0 "$PERCUSS_BUILD/tests/service/same_body" "$work/alone.h5" "$work/mpi.h5" 1e-10 1e-8
    done
}

say "a free block on one process and on four"
block 12 4 3 >"$work/block.inp"
same block.inp "1 4" --modes 20

say "held at one end, all modes below a frequency"
block 6 3 2 >"$work/held.inp"
same held.inp 2 --fixed low --max-frequency 120e3

say "two frequencies of a square cross-section are one, none is lost, and no pair is cut"
block 6 2 2 >"$work/square.inp"
expect 0 mpirun --oversubscribe -n 2 "$bin/percuss-reduce-mpi" "$work/square.inp" $steel --modes 12 -o "$work/mpi.h5"
# the twelfth and the thirteenth are copies
[ "$(field modes)" -eq 13 ] || fail "modes $(field modes)"

# the first process has all there is then, and hands it out with the factor
if command -v ccx >/dev/null; then
    say "matrices that CalculiX has assembled"
    { block 4 3 2 && cat <<INP; } >"$work/ccx.inp"
*MATERIAL, NAME=steel
*ELASTIC
210000, 0.3
*DENSITY
7.8e-9
*SOLID SECTION, ELSET=left, MATERIAL=steel
*SOLID SECTION, ELSET=right, MATERIAL=steel
*BOUNDARY
low, 1, 3
*STEP
*FREQUENCY, SOLVER=MATRIXSTORAGE
5
*END STEP
INP
    (cd "$work" && ccx ccx >/dev/null 2>&1)
    steel="--unit mm --json"
    same ccx.inp 3 --modes 5 --stiffness "$work/ccx.sti" --mass "$work/ccx.mas" --freedoms "$work/ccx.dof"
fi

say "every process ends when the first does"
expect 2 timeout 60 mpirun --oversubscribe -n 2 "$bin/percuss-reduce-mpi"
expect 1 timeout 60 mpirun --oversubscribe -n 2 "$bin/percuss-reduce-mpi" "$work/none.inp" -o "$work/none.h5"
says 'none.inp'
