/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The datasets of a body file: one list, which writing, reading and checks follow. */
#ifndef PERCUSS_MESH_BODY_LAYOUT_H
#define PERCUSS_MESH_BODY_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>

#include "model/mesh_body.h"

enum { LAYOUT_MOST = 40, LAYOUT_RANK = 3 };

enum layout_type { LAYOUT_REAL64, LAYOUT_REAL32, LAYOUT_WHOLE32, LAYOUT_WHOLE8, LAYOUT_NAME };

/* What numbers may be. */
enum layout_range {
    LAYOUT_FINITE,
    LAYOUT_POSITIVE,
    LAYOUT_NOT_NEGATIVE,
    LAYOUT_OR_UNKNOWN /* NAN too */,
    LAYOUT_OR_INFINITE
};

struct layout {
    const char *name; /* in the file */
    const char *unit;
    enum layout_type type;
    enum layout_range range;
    int rank;
    const size_t *extent[LAYOUT_RANK]; /* where they stand */
    bool counts;                       /* a reader takes the first extent from this dataset */
    bool optional;
    bool packed; /* large: in compressed pieces */
    void *value; /* where it stands; NULL: *array is allocated by a reader */
    void **array;
};

/* Faces and materials, which the file holds member by member. */
struct layout_flat {
    unsigned char *face_count, *face_material;
    unsigned *face_patch, *face_nodes;
    float *normal, *curvature, *doubt;
    double *flexibility, *slope;
    char (*names)[PERCUSS_ID_SIZE];
    double *young, *poisson, *density, *yield, *tangent;
    unsigned supported, removed;
};

/* Fills the list for a body and what is beside it; the number of datasets. */
size_t layout_list(struct mesh_body *body, struct layout_flat *flat,
                   struct layout list[LAYOUT_MOST]);

/* Room for the flat arrays of as many faces and materials as the body has. False: out of memory. */
bool layout_flat_allocate(struct layout_flat *flat, const struct mesh_body *body);
void layout_flat_free(struct layout_flat *flat);

/* From the body to the flat arrays, and back to a body whose faces and materials are allocated. */
void layout_flatten(const struct mesh_body *body, struct layout_flat *flat);
void layout_unflatten(const struct layout_flat *flat, struct mesh_body *body);

/* Bytes of one number. */
size_t layout_size(enum layout_type type);

/* Whether every number of `count` is one that the range allows; *at is the first that is not. */
bool layout_holds(const struct layout *layout, const void *data, size_t count, size_t *at);

/* What the range allows, in words that follow "must be". */
const char *layout_allowed(enum layout_range range);

#endif
