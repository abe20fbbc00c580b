/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A quantity known at places of a surface, everywhere on it: moving least squares within a patch
 * and material, cubic in space, and one term that grows towards sharp edges as a flexibility does.
 */
#ifndef PERCUSS_REDUCE_SITE_FIELD_H
#define PERCUSS_REDUCE_SITE_FIELD_H

#include "model/mesh_body.h"
#include "reduce/flexibility_place.h"

enum { SITE_FIELD_NEIGHBOURS = 28 };

enum { SITE_FIELD_EDGE_TERMS = 4 };

/* Owns its arrays; edges and places are borrowed. */
struct site_field {
    const struct flexibility_edges *edges;
    double size;    /* m, of the mesh */
    double spacing; /* m, of the places */
    size_t count;
    const struct flexibility_place *places; /* [count], borrowed */
    const struct surface_face **faces;      /* [count], borrowed */
    double (*points)[3], (*normals)[3], *values;
    double (*edge_terms)[SITE_FIELD_EDGE_TERMS];   /* [count] */
    double (*coefficients)[SITE_FIELD_EDGE_TERMS]; /* [patch_count] */
};

/* Values that are NAN count as not known. False: no memory. */
bool site_field_make(struct site_field *field, const struct surface_rule *rule,
                     const struct flexibility_edges *edges, size_t count,
                     const struct flexibility_place *places, const double *values, double spacing);
void site_field_free(struct site_field *field);

/* The value at x, a point of the face with the normal `outward`; NAN: no value is known
 * nearby. */
double site_field_at(const struct site_field *field, const struct surface_face *face,
                     const double x[3], const double outward[3]);

/* Interpolation from the other places less the value at a place; NAN: nothing. */
double site_field_error(const struct site_field *field, size_t place);

/* Fills the faces' flexibility and flexibility_slope; the surface is fitted. Along a sharp edge
 * flexibilities grow like 1/distance: nodes at one get the values that make a face's shape
 * functions come out best within it, from a third of the mesh's edges on. PERCUSS_INTERNAL without
 * memory. */
enum percuss_status site_field_spread(const struct site_field *field,
                                      const struct surface_rule *rule, struct mesh_body *body,
                                      struct fault *fault);

/* Half the trace of a curvature. */
double site_field_curvature(const struct surface_point *point);

/* Makes all flexibilities of a face NAN where its interpolation at a place differs from the solved
 * value by more than the allowed error near an edge, where near an edge it would give a contact a
 * negative compliance, and on walls that are too thin (flexibility_place_thin). The faces are
 * filled (site_field_spread). Returns the number of faces without a flexibility. */
size_t site_field_check(const struct site_field *field, const struct surface_rule *rule,
                        struct mesh_body *body);

#endif
