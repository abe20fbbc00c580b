/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The processes of mpirun: the first one reads, decides and writes; the others follow its orders
 * into everything that is done together. */
#ifndef PERCUSS_REDUCE_MPI_TEAM_H
#define PERCUSS_REDUCE_MPI_TEAM_H

#include <stdbool.h>
#include <stdint.h>

enum team_job { TEAM_MAKE, TEAM_COMPUTE, TEAM_SOLVE, TEAM_MODES, TEAM_FREE, TEAM_END };

struct team_order {
    uint64_t key; /* which matrices: as TEAM_MAKE named them */
    enum team_job job;
    bool positive;              /* TEAM_MAKE */
    double shift;               /* TEAM_COMPUTE, TEAM_MODES */
    uint64_t count;             /* TEAM_SOLVE: right-hand sides; TEAM_MODES */
    uint64_t rigid_count, seed; /* TEAM_MODES */
};

/* By the first process before it does its own part of the job. */
void team_order(struct team_order order);

/* By the others: until TEAM_END. */
void team_follow(void);

#endif
