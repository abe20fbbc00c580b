/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The elastic modes of a body that was reduced from a mesh, or of a box (ritz.h), with the static
 * compliance that they do not hold: one family, of as many modes as there are. */
#ifndef PERCUSS_MODEL_MESH_FAMILY_H
#define PERCUSS_MODEL_MESH_FAMILY_H

#include "model/mode_family.h"

struct ritz_shape;
struct site;
struct site_load;

extern const struct mode_family mesh_family;

/* Of kinds with a box: the load but for its flexibility, which who lends the modes says; the name
 * of the theory. */
void mesh_family_load(const struct body *body, const struct site *site, const double direction[3],
                      struct site_load *load);
const char *mesh_family_theory(const struct body *body);

/* The box of a body of three sides, its ends held as its supports say. False: beyond Ritz's reach.
 */
bool mesh_family_box(const struct body *body, struct ritz_shape *shape);

/* What a body is of the one in its file: young, density and size over its own. */
struct mesh_ratio {
    double young, density, size;
};
struct mesh_ratio mesh_ratio_of(const struct body *body);

/* Flexibilities over those of the file: 1/(E L). */
double mesh_ratio_flexibility(const struct body *body);

#endif
