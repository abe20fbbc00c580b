/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_IMPACT_STEP_COST_H
#define PERCUSS_IMPACT_STEP_COST_H

#include "impact/scene.h"

/* The work of one contact step or flight interval, see impact_settings.max_work. */
double step_cost(const struct scene *scene);

#endif
