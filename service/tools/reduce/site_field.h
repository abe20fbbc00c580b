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

/* A place's neighbours with a value, and their weights in the value that they give it. */
struct site_others {
    size_t count, places[SITE_FIELD_NEIGHBOURS];
    double weights[SITE_FIELD_NEIGHBOURS];
};

/* Owns its arrays; edges and places are borrowed. */
struct site_field {
    const struct solid_mesh *mesh; /* borrowed */
    const struct flexibility_edges *edges;
    double size;    /* m, of the mesh */
    double spacing; /* m, of the places */
    size_t patch_count;
    size_t count;
    const struct flexibility_place *places; /* [count], borrowed */
    const struct surface_face **faces;      /* [count], borrowed */
    double (*points)[3], (*normals)[3];
    struct site_others *others;      /* [count]; of none: no value, or no other is near enough */
    struct site_field_part parts[2]; /* the normal's, the others */
};

/* Values that are NAN count as not known. `tensors`: [count], NULL: not wanted; their part along
 * the normal is of no matter. False: no memory. */
bool site_field_make(struct site_field *field, const struct surface_rule *rule,
                     const struct flexibility_edges *edges, size_t count,
                     const struct flexibility_place *places, const double *values,
                     const double (*tensors)[6], double spacing);
void site_field_free(struct site_field *field);

/* Gives the places other values along the normal: NAN where they were NAN. False: no memory. */
bool site_field_refit(struct site_field *field, const double *values);

/* The numbers at x, a point of the face with the normal `outward`; NAN: no value is known nearby.
 */
void site_field_at(const struct site_field *field, const struct surface_face *face,
                   const double x[3], const double outward[3], double numbers[SITE_FIELD_NUMBERS]);

/* Interpolation along the normal from the other places less the value at a place; NAN: nothing. */
double site_field_error(const struct site_field *field, size_t place);

/* Whether a place has a value. */
bool site_field_known(const struct site_field *field, size_t place);

/* Whether two parts of the mesh are equally stiff: a flexibility goes on from one to the other. */
bool site_field_alike(const struct solid_mesh *mesh, size_t one, size_t other);

#endif
