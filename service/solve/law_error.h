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

/* The same of one that yielded, by what it remembers: by size and shape of the contact, and by the
 * law itself. */
void law_error_parts(const struct problem *problem, size_t contact,
                     const struct contact_history *history, double parts[2]);

/* Depth at which a law that yields has taken up a work, from its virgin curve, m. */
double law_error_depth(const struct contact_law *law, double work);

/* How many times as large a stress of yield changes what a contact alone gives back from a depth by
 * the share `share` of its restitution; at most 3. */
double law_error_yield(const struct contact_law *law, double depth, double share);

/* What most of it comes from, in words. */
const char *law_error_reason(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact);

/* The largest of all contacts. */
double law_error_worst(const struct problem *problem, const struct impact_outcome *outcome);

#endif
