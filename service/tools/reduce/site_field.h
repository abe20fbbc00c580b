/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A flexibility known at places of a surface, everywhere on it: moving least squares within a patch
 * and stiffness, cubic in space, and terms that grow towards sharp edges as a flexibility does. It
 * has up to seven numbers: that along the normal, and the tensor between all directions without
 * that (xx yy zz xy yz zx of the mesh's frame, so that no tangents need be chosen). */
#ifndef PERCUSS_REDUCE_SITE_FIELD_H
#define PERCUSS_REDUCE_SITE_FIELD_H

#include "model/mesh_body.h"
#include "reduce/flexibility_place.h"

enum { SITE_FIELD_NEIGHBOURS = 28 };

enum { SITE_FIELD_NUMBERS = 7, SITE_FIELD_EDGE_TERMS = 8 };

/* Numbers that share their edge terms. Owns its arrays. */
struct site_field_part {
    size_t width, terms;                           /* width 0: not wanted */
    double *values;                                /* [count][width] */
    double *edge_terms;                            /* [count][terms][width] */
    double (*coefficients)[SITE_FIELD_EDGE_TERMS]; /* [patch_count] */
};

/* Owns its arrays; edges and places are borrowed. */
struct site_field {
    const struct solid_mesh *mesh; /* borrowed */
    const struct flexibility_edges *edges;
    double size;    /* m, of the mesh */
    double spacing; /* m, of the places */
    size_t count;
    const struct flexibility_place *places; /* [count], borrowed */
    const struct surface_face **faces;      /* [count], borrowed */
    double (*points)[3], (*normals)[3];
    struct site_field_part parts[2]; /* the normal's, the others */
};

/* Values that are NAN count as not known. `tensors`: [count], NULL: not wanted; their part along
 * the normal is of no matter. False: no memory. */
bool site_field_make(struct site_field *field, const struct surface_rule *rule,
                     const struct flexibility_edges *edges, size_t count,
                     const struct flexibility_place *places, const double *values,
                     const double (*tensors)[6], double spacing);
void site_field_free(struct site_field *field);

/* The numbers at x, a point of the face with the normal `outward`; NAN: no value is known nearby.
 */
void site_field_at(const struct site_field *field, const struct surface_face *face,
                   const double x[3], const double outward[3], double numbers[SITE_FIELD_NUMBERS]);

/* Interpolation along the normal from the other places less the value at a place; NAN: nothing. */
double site_field_error(const struct site_field *field, size_t place);

/* Fills the faces' flexibility, flexibility_slope and, if it is wanted, tensor; the surface is
 * fitted. Along a sharp edge
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
 * filled (site_field_spread). The tensors of a face alike, by themselves where they differ by more
 * from those solved for. Returns the number of faces without a flexibility. */
size_t site_field_check(const struct site_field *field, const struct surface_rule *rule,
                        struct mesh_body *body);

#endif
