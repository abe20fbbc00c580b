/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Matched local compliance: what goes in series with a contact law so that law, modes and residual
 * flexibility together are the real bodies' static compliance (fe/matched.h). */
#ifndef PERCUSS_SOLVE_COMPLIANCE_H
#define PERCUSS_SOLVE_COMPLIANCE_H

#include "impact/impact.h"
#include "solve/problem.h"

/* The request's choice, or `otherwise` where it makes none: matched where every contact has it.
 * Without being asked for, contacts of bodies that do not vibrate stay Hertz's: no basis there
 * holds anything twice. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status compliance_choose(struct problem *problem, enum percuss_compliance otherwise,
                                      struct fault *fault);

/* Looks at a solution: true: the series compliance (residual flexibility included) is too negative
 * for the law's stiffness, |C| dF/dd >= 0.5: half-spaces are still now or, where they were, all
 * contacts' compliance is the half-space's. They are still too where the effort was spent on
 * contacts that share their waves: each by itself takes far less. */
bool compliance_revise(struct problem *problem, const struct scene *scene,
                       const struct impact_outcome *outcome);

#endif
