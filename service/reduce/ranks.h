/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Who takes part in factors: this process alone, or processes under MPI of which this is the first
 * and the others follow it into every job of MUMPS. Each program links one of the two. */
#ifndef PERCUSS_REDUCE_RANKS_H
#define PERCUSS_REDUCE_RANKS_H

/* Before a job of MUMPS: the others do the same job for the instance of that key, which the first
 * job, -1, makes and the last, -2, ends. `symmetry` is MUMPS's SYM. */
void ranks_follow(const void *key, int symmetry, int job);

#endif
