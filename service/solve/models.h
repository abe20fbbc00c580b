/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The models of a request's contacts, the laws and what is in series with them: chosen before a
 * solution, looked at again after it. */
#ifndef PERCUSS_SOLVE_MODELS_H
#define PERCUSS_SOLVE_MODELS_H

#include "solve/accuracy.h"
#include "solve/contact_model.h"

/* What the choice needs besides the request; all borrowed. */
struct models_source {
    const struct body_set *catalogue;
    const struct contact_table_source *tables; /* NULL: none */
    struct attempt_means means;
};

/* After geometry_find. PERCUSS_OK, or the refusals of contact_model_choose and compliance_choose.
 */
enum percuss_status models_choose(struct geometry *geometry, const struct solve_request *request,
                                  const struct models_source *source, struct fault *fault);

/* Looks at a solution of a scene: true: other models are in order and are now the geometry's. */
bool models_revise(struct geometry *geometry, const struct scene *scene,
                   const struct impact_outcome *outcome);

/* Chooses, and solves to the request's tolerance until nothing is left to revise. */
enum percuss_status models_solve(struct accuracy *accuracy, struct geometry *geometry,
                                 const struct solve_request *request,
                                 const struct models_source *source, struct fault *fault);

#endif
