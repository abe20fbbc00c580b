/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What deviations of the models (model_deviation.h) make of a sequence of sub-impacts: the answer
 * solved again with its contacts softer and stiffer, and yielding earlier and later, by as much as
 * is uncertain of them. These are the solutions beside it. */
#ifndef PERCUSS_SOLVE_MODEL_PERTURBED_H
#define PERCUSS_SOLVE_MODEL_PERTURBED_H

#include "solve/model_deviation.h"
#include "solve/solution.h"

/* An answer, and what is uncertain of each of its contacts. */
struct model_margin {
    const struct problem *problem;
    const struct solution *solution;
    struct model_blow *blow;           /* [contact] */
    struct model_deviation *deviation; /* [contact] */
};

/* Between the answer and those beside it e need not lie between theirs. */
static const double MODEL_PERTURBED_BETWEEN = 1.5;

/* Widens the error of e, and those of the contacts' impulses (N s), to how far such solutions are
 * from the answer, the farthest of them. INFINITY: nobody knows. PERCUSS_OK, PERCUSS_INTERNAL or
 * PERCUSS_TIMEOUT. */
enum percuss_status model_perturbed_find(const struct model_margin *margin, struct pace *pace,
                                         double *restitution, double *impulse);

#endif
