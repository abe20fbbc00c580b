/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The lowest modes of spread matrices by SLEPc: Krylov-Schur with the factor of K + shift M. Calls
 * as in spread.h. */
#ifndef PERCUSS_REDUCE_MPI_SPREAD_MODES_H
#define PERCUSS_REDUCE_MPI_SPREAD_MODES_H

#include "base/watch.h"
#include "reduce_mpi/spread.h"

struct spread_modes_task {
    size_t count, rigid_count;
    double shift;  /* 1/s^2: K + shift M is factored */
    uint64_t seed; /* of the first vector */
    /* on the first process alone */
    const double *rigid;       /* [rigid_count][n], M-orthonormal: kept out */
    const struct watch *watch; /* told the part done; NULL: no watch */
};

/* Fills `squares` [count], ascending, 1/s^2, and on the first process `shapes` [count][n],
 * M-orthonormal. PERCUSS_TIMEOUT: the watch stopped it; PERCUSS_INTERNAL: no convergence. */
enum percuss_status spread_modes(struct spread *spread, const struct spread_modes_task *task,
                                 double *squares, double *shapes);

#endif
