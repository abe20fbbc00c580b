/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A flexibility that is known everywhere on a surface, as values at the nodes of its faces. */
#ifndef PERCUSS_REDUCE_SITES_SPREAD_H
#define PERCUSS_REDUCE_SITES_SPREAD_H

#include "model/mesh_body.h"
#include "reduce/site_field.h"

/* Fills the faces' flexibility and flexibility_slope; the surface is fitted. Along a sharp edge
 * flexibilities grow like 1/distance: nodes at one get what makes a face's shape functions come out
 * best within it, from a third of the mesh's edges on. PERCUSS_INTERNAL without memory. */
enum percuss_status sites_spread(const struct site_field *field, const struct surface_rule *rule,
                                 struct mesh_body *body, struct fault *fault);

/* Half the trace of a curvature. */
double sites_mean_curvature(const struct surface_point *point);

#endif
