/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "fe/impact_complete.h"

void impact_complete_extrapolate(struct complete_convergence *convergence)
{
    const struct complete_result *result = convergence->result;
    double first = result[1].restitution - result[0].restitution;
    double second = result[2].restitution - result[1].restitution;
    convergence->order = log2(fabs(first / second));
    /* Linear elements converge with the second order where nothing else happens; nodes that close
     * one by one add a part that jitters with the patch's radius over their distance. A change of
     * sign is that jitter: nothing to extrapolate. Two values may lie close together by it alone:
     * the error does not fall faster than the second order. */
    double order = fmin(fmax(convergence->order, 1.0), 2.0);
    double correction = first * second > 0.0 ? second / (exp2(order) - 1.0) : 0.0;
    convergence->restitution = result[2].restitution + correction;
    convergence->error =
        fmax(correction == 0.0 ? fabs(second) : fabs(correction), fabs(first) / 12.0);
}

enum percuss_status impact_complete_converge(const struct complete_problem *problem,
                                             struct complete_convergence *convergence,
                                             struct fault *fault)
{
    for (int i = 0; i < 3; i++) {
        struct complete_problem one = *problem;
        one.cells = problem->cells >> (2 - i);
        enum percuss_status status = impact_complete_solve(&one, &convergence->result[i], fault);
        if (status != PERCUSS_OK)
            return status;
    }
    impact_complete_extrapolate(convergence);
    return PERCUSS_OK;
}
