/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What must hold for every answer, converged or not. */
#ifndef PERCUSS_TEST_ESTIMATES_INVARIANTS_H
#define PERCUSS_TEST_ESTIMATES_INVARIANTS_H

#include "physics/support.h"

/* What an answer breaks, in words; NULL: nothing. */
const char *invariant_broken(const struct solve_result *result, double tolerance);

#endif
