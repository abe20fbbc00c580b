/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The scale of an impact before it is solved, and the work of its steps. */
#ifndef PERCUSS_IMPACT_IMPACT_SCALE_H
#define PERCUSS_IMPACT_IMPACT_SCALE_H

#include "impact/scene.h"

/* Scales of a contact that begins at an approach rate: those of an elastic collision of the masses
 * that it feels meanwhile. */
struct impact_scale {
    double duration; /* indentation / rate, s */
    double indentation;
    double force;
};
struct impact_scale impact_scale_of(const struct scene *scene, size_t contact, double rate);

/* The work of one contact step or flight interval, see impact_settings.max_work. */
double step_cost(const struct scene *scene);

#endif
