/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/model_shift.h"

#include <math.h>

#include "contact/plastic.h"
#include "solve/law_error.h"
#include "solve/model_deviation.h"

static bool is_shifted(const double *shift)
{
    return shift[SOLVE_SHIFT_FORCE] != 0.0 || shift[SOLVE_SHIFT_COMPLIANCE] != 0.0 ||
           shift[SOLVE_SHIFT_YIELD] != 0.0;
}

/* One contact, by what its blow is expected to be: that of the answer is not known yet. */
static void shift_contact(struct problem *problem, size_t c)
{
    const double *shift = problem->request->model_shift;
    struct contact_law *law = &problem->contact_model.laws[c];
    struct model_blow blow = model_blow_expected(problem, c);
    struct model_deviation deviation = model_deviation_of(problem, c, &blow);
    /* the law's force and the compliance behind it */
    double force = shift[SOLVE_SHIFT_FORCE] * deviation.force / MODEL_DEVIATION_SIGMAS;
    double yield = 1.0;
    problem->shift[c] =
        shift[SOLVE_SHIFT_COMPLIANCE] * deviation.compliance / MODEL_DEVIATION_SIGMAS;
    /* the stress of yield, where it matters */
    if (law->operations->curve && deviation.yield > 0.0) {
        double share = fabs(shift[SOLVE_SHIFT_YIELD]) * deviation.yield / MODEL_DEVIATION_SIGMAS;
        yield = law_error_yield(law, blow.history.max_indentation, share);
        if (shift[SOLVE_SHIFT_YIELD] < 0.0)
            yield = 1.0 / yield;
    }
    *law = contact_law_rescaled(law, exp(force), yield);
}

enum percuss_status model_shift_apply(struct problem *problem, struct fault *fault)
{
    size_t n = problem->contact_count;
    if (!is_shifted(problem->request->model_shift))
        return PERCUSS_OK;
    problem->shift = arena_take(problem->arena, n, sizeof *problem->shift);
    if (!problem->shift)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t c = 0; c < n; c++)
        shift_contact(problem, c);
    return PERCUSS_OK;
}
