/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The bricks of a shape, halved in all three directions again and again near the contact. Where
 * halves meet a brick that is whole, their nodes hang on its face: their displacement is the one
 * that its own nodes give there, so that the field stays continuous. */
#ifndef PERCUSS_SPATIAL_REFINED_H
#define PERCUSS_SPATIAL_REFINED_H

#include "base/fault.h"
#include "spatial/brick.h"
#include "spatial/shape.h"

struct refined_brick {
    unsigned level; /* how often halved */
    size_t block;
    size_t nodes[BRICK_NODES];
};

/* Owns its arrays. */
struct refined {
    size_t brick_count, node_count;
    struct refined_brick *bricks;
    double (*points)[3]; /* [node_count], m */
    /* node n hangs on masters[first[n]] ... masters[first[n + 1] - 1], which do not hang; none: it
     * is free */
    size_t *first, *masters;
    double *weights;
    double edge;     /* m: nodes as far along any axis are held; 0: none */
    size_t touching; /* nodes of the face that holds the contact, as far as halved most */
    size_t *surface;
};

/* Halves a shape's bricks up to `levels` times around its core. OK, or INTERNAL: no memory. */
enum percuss_status refined_create(const struct shape *shape, unsigned levels, struct refined *mesh,
                                   struct fault *fault);
void refined_free(struct refined *mesh);

#endif
