/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Unloading branches as computed (recovery at fractions of the force) and as laws take them (shares
 * of the force at equal steps of the way back). */
#ifndef PERCUSS_STORE_BRANCH_SHARES_H
#define PERCUSS_STORE_BRANCH_SHARES_H

#include <stdbool.h>
#include <stddef.h>

#include "fe/indentation.h"

enum { BRANCH_SHARES_SCRATCH = 5 * INDENTATION_SAMPLES };

/* Whether a recovery [INDENTATION_SAMPLES] rises from 0 to 1. */
bool branch_shares_possible(const double *recovery);

/* Fills share[count]. F^(2/3) is nearly a straight line of the way back, and interpolated by a
 * spline; `part` of the way from Hertz's branch (0) to the computed one (1). */
void branch_shares_fill(const double *recovery, double part, size_t count, double *share,
                        double scratch[BRANCH_SHARES_SCRATCH]);

#endif
