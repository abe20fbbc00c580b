/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The spread of the solutions around an answer. A sequence of sub-impacts amplifies the errors of
 * model and steps, at times beyond all bounds: then the answer is one of a range, and only other
 * solutions of the same accuracy show how wide that is. */
#ifndef PERCUSS_SOLVE_ERROR_NEIGHBOURS_H
#define PERCUSS_SOLVE_ERROR_NEIGHBOURS_H

#include "impact/impact.h"
#include "solve/problem.h"

struct neighbours {
    size_t solutions;
    double low[PERCUSS_MAX_CONTACTS], high[PERCUSS_MAX_CONTACTS]; /* restitution; NAN: has none */
    double weakest[PERCUSS_MAX_CONTACTS], strongest[PERCUSS_MAX_CONTACTS]; /* impulse, N s */
    size_t fewest[PERCUSS_MAX_CONTACTS], most[PERCUSS_MAX_CONTACTS];       /* sub-impacts */
    double
        tangential[PERCUSS_MAX_CONTACTS]; /* N s, by which its tangential impulse differs at most */
    double vibration[PERCUSS_MAX_BODIES]; /* J, by which that of a body differs at most */
    struct impact_outcome answer;         /* from which it does */
};

/* The range of one solution alone. */
void neighbours_begin(struct neighbours *neighbours, const struct problem *problem,
                      const struct impact_outcome *answer);

/* Widens it by another solution of the same contacts, which was not cut off. */
void neighbours_add(struct neighbours *neighbours, const struct problem *problem,
                    const struct impact_outcome *other);

/* Largest distance of an answer's restitution from the ends of the range, as large as it can be
 * where there is no other solution. */
double neighbours_distance(const struct neighbours *neighbours, const struct problem *problem,
                           const struct impact_outcome *answer);

/* The same of one contact's impulse, N s. */
double neighbours_impulse_distance(const struct neighbours *neighbours,
                                   const struct impact_outcome *answer, size_t contact);

#endif
