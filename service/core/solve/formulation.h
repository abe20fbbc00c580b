/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From a request to its problem: bodies and contacts are placed, models chosen, and revised where a
 * solution contradicts them. */
#ifndef PERCUSS_SOLVE_FORMULATION_H
#define PERCUSS_SOLVE_FORMULATION_H

#include "impact/impact.h"
#include "solve/problem.h"

/* Places the bodies of an empty problem, and chooses its contacts' laws and the compliance in
 * series with them. PERCUSS_OK, PERCUSS_TIMEOUT where the watch stops it, or the refusals of
 * placement_find, contact_model_choose and compliance_choose. */
enum percuss_status formulate(struct problem *problem, const struct solve_context *context,
                              struct fault *fault);

/* Checks the choices against a solution of a scene. True: other laws or another compliance are
 * needed and are now the problem's. */
bool formulation_revise(struct problem *problem, const struct scene *scene,
                        const struct impact_outcome *outcome);

/* Places bodies and contacts and computes their rates: all of an empty problem but the laws and the
 * compliance. PERCUSS_OK, or the refusal with its message: UNKNOWN_BODY, BAD_REQUEST,
 * UNSUPPORTED_GEOMETRY, NOT_APPROACHING. */
enum percuss_status placement_find(struct problem *problem, const struct body_set *catalogue,
                                   struct fault *fault);

/* Recomputes the part that depends on velocities, after the request's have changed. OK,
 * NOT_APPROACHING or BAD_REQUEST. */
enum percuss_status placement_find_rates(struct problem *problem, struct fault *fault);

#endif
