/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/models.h"

#include "solve/compliance.h"

enum percuss_status models_choose(struct geometry *geometry, const struct solve_request *request,
                                  const struct models_source *source, struct fault *fault)
{
    enum percuss_status status =
        contact_model_choose(geometry, request, source->tables, source->means.arena, fault);
    if (!status)
        status = compliance_choose(geometry, request, source->catalogue, source->means.cache,
                                   source->means.arena, fault);
    return status;
}

bool models_revise(struct geometry *geometry, const struct scene *scene,
                   const struct impact_outcome *outcome)
{
    return contact_model_revise(geometry, outcome) || compliance_revise(geometry, scene, outcome);
}

enum percuss_status models_solve(struct accuracy *accuracy, struct geometry *geometry,
                                 const struct solve_request *request,
                                 const struct models_source *source, struct fault *fault)
{
    enum percuss_status status = models_choose(geometry, request, source, fault);
    bool revised = true;
    while (!status && revised) {
        status = accuracy_solve(accuracy, geometry, request, &source->means, fault);
        revised =
            !status && models_revise(geometry, &accuracy->assembly->scene, &accuracy->outcome);
    }
    return status;
}
