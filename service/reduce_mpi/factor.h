/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What is behind reduce/factor.h here: matrices and factor on all processes. */
#ifndef PERCUSS_REDUCE_MPI_FACTOR_H
#define PERCUSS_REDUCE_MPI_FACTOR_H

#include "reduce/factor.h"
#include "reduce_mpi/spread.h"

struct spread *factor_spread(struct factor *factor);

/* The name that the other processes know it by. */
uint64_t factor_key(const struct factor *factor);

#endif
