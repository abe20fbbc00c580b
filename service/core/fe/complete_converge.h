/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Limit of a complete finite-element impact's restitution for small elements, and its
 * uncertainty. */
#ifndef PERCUSS_FE_COMPLETE_CONVERGE_H
#define PERCUSS_FE_COMPLETE_CONVERGE_H

#include <stdbool.h>

#include "fe/impact_complete.h"
#include "fe/swing.h"

/* One impact on meshes that differ in the places of their nodes: its mean. */

/* Mean of `count` results, > 0, by weights >= 0 with the sum 1. Impulses, energies, times and
 * lengths are means, so that sums and balances of each hold for it; counts are those of the result
 * of the largest weight, momentum_error the worst. False: they differ in their sub-impacts' number
 * or their ends, and have no mean. */
bool complete_mean(const struct complete_result *results, const double *weights, size_t count,
                   struct complete_result *mean);

enum { COMPLETE_MESHES = 3 };

struct complete_convergence {
    struct swing swing[COMPLETE_MESHES]; /* coarse to fine */
    unsigned meshes;
    double restitution; /* the limit */
    double order;       /* of three meshes, observed; between 1 and 2 it is used; else NAN */
    double error;       /* of the limit, estimated */
    struct complete_result result; /* on the finest mesh: the phases' mean that has the limit */
    unsigned cells;                /* its mesh */
    double result_error; /* of its restitution: `error`, and how far it is from the limit */
};

/* Limit, order and error from the means of two or three meshes, each twice as fine as the one
 * before. */
void complete_converge_judge(struct complete_convergence *convergence);

/* Solves on meshes of a quarter, half and all of problem->cells (at least 16), with more phases or
 * another mesh until the estimated error is within `tolerance`; 0: all. Where the phases differ in
 * their course some more may follow, until one lies near the limit. `phase` and `sample` of
 * `problem` are not used; its `pace` is told the part done of all meshes. Status as
 * impact_complete_solve. Same input, same bits. */
enum percuss_status complete_converge(const struct complete_problem *problem, double tolerance,
                                      struct complete_convergence *convergence,
                                      struct fault *fault);

#endif
