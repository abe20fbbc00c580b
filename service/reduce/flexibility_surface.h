/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Integrals over a body's surface of the half-space's field that belongs to a force at a place. */
#ifndef PERCUSS_REDUCE_FLEXIBILITY_SURFACE_H
#define PERCUSS_REDUCE_FLEXIBILITY_SURFACE_H

#include "reduce/flexibility_place.h"

/* With the field's tractions t and displacements u: subtracts the nodal forces that do t's work,
 * the integral of N^T t, from force ([3 node_count], N), and returns the integral of t.u (m/N),
 * outside the place's cut. */
double flexibility_surface_add(const struct surface_rule *rule,
                               const struct flexibility_place *place, double *force);

#endif
