/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/formulation.h"

#include "base/watch.h"
#include "solve/compliance.h"
#include "solve/contact_model.h"
#include "solve/error/deviation.h"
#include "solve/placement.h"
#include "solve/vibration.h"

enum percuss_status formulate(struct problem *problem, const struct solve_means *means,
                              struct fault *fault)
{
    struct pace pace = {.watch = &means->watch};
    enum percuss_status status = placement_find(problem, means->catalogue, fault);
    if (!status)
        status = contact_model_choose(problem, means->tables, fault);
    if (!status && problem->request->options.contact_model != PERCUSS_CONTACT_COMPLETE_FE)
        status = vibration_lend(problem, means->catalogue->boxes, &pace, fault);
    if (!status)
        status = compliance_choose(problem, means->catalogue->compliance, fault);
    if (!status)
        status = deviation_shift(problem, fault);
    return status;
}

bool formulation_revise(struct problem *problem, const struct scene *scene,
                        const struct impact_outcome *outcome)
{
    struct fault lost; /* of memory: the arena tells */
    bool laws = contact_model_revise(problem, outcome);
    bool revised = laws || compliance_revise(problem, scene, outcome);
    if (laws)
        deviation_shift(problem, &lost);
    return revised;
}
