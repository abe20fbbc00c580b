/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "fe/impact_complete.h"

enum percuss_status impact_complete_converge(const struct complete_problem *problem,
                                             struct complete_convergence *convergence,
                                             struct fault *fault)
{
    double e[3];
    for (int i = 0; i < 3; i++) {
        struct complete_problem one = *problem;
        one.cells = problem->cells >> (2 - i);
        enum percuss_status status = impact_complete_solve(&one, &convergence->result[i], fault);
        if (status != PERCUSS_OK)
            return status;
        e[i] = convergence->result[i].restitution;
    }
    convergence->order = log2(fabs((e[1] - e[0]) / (e[2] - e[1])));
    /* linear elements: between first and second order; outside, the meshes are too coarse to tell
     */
    double order = fmin(fmax(convergence->order, 1.0), 2.0);
    double correction = (e[2] - e[1]) / (exp2(order) - 1.0);
    convergence->restitution = e[2] + correction;
    convergence->error = fabs(correction);
    return PERCUSS_OK;
}
