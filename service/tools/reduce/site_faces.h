/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A flexibility that sites know (site_field.h), given to the nodes of a surface's faces, between
 * which a body's file interpolates; and those faces that cannot be trusted. */
#ifndef PERCUSS_REDUCE_SITE_FACES_H
#define PERCUSS_REDUCE_SITE_FACES_H

#include "reduce/site_field.h"

/* Fills the faces' flexibility, flexibility_slope and, if it is wanted, tensor; the surface is
 * fitted. Along a sharp edge flexibilities grow like 1/distance: nodes at one get the values that
 * make a face's shape functions come out best within it, from a third of the mesh's edges on.
 * PERCUSS_INTERNAL without memory. */
enum percuss_status site_faces_fill(const struct site_field *field, const struct surface_rule *rule,
                                    struct mesh_body *body, struct fault *fault);

/* At how many points that asks the field, before any value is known: at nodes, and all over the
 * faces near sharp edges. */
size_t site_faces_points(const struct site_field *field, const struct surface_rule *rule);

/* Half the trace of a curvature. */
double site_faces_curvature(const struct surface_point *point);

/* Makes all flexibilities of a face NAN where its interpolation at a place differs from the solved
 * value by more than the allowed error near an edge, where near an edge it would give a contact a
 * negative compliance, and on walls that are too thin (flexibility_place_thin). The faces are
 * filled (site_faces_fill). The tensors of a face alike, by themselves where they differ by more
 * from those solved for. Returns the number of faces without a flexibility. */
size_t site_faces_check(const struct site_field *field, const struct surface_rule *rule,
                        struct mesh_body *body);

#endif
