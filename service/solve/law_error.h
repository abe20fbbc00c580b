/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How wrong the contact law itself is, beyond what modes and steps leave. */
#ifndef PERCUSS_SOLVE_LAW_ERROR_H
#define PERCUSS_SOLVE_LAW_ERROR_H

#include "impact/impact.h"
#include "solve/contact_model.h"
#include "solve/problem.h"

/* An estimate for a contact after a solution, as a part of the restitution; 0: Hertz below yield.
 */
double law_error(const struct problem *problem, const struct impact_outcome *outcome,
                 size_t contact);

/* What most of it comes from, in words. */
const char *law_error_reason(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact);

/* The largest of all contacts. */
double law_error_worst(const struct problem *problem, const struct impact_outcome *outcome);

#endif
