/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Nodes that hang on the faces of larger bricks, and what they hang on in the end. */
#ifndef PERCUSS_SPATIAL_HANGING_H
#define PERCUSS_SPATIAL_HANGING_H

#include <stdbool.h>
#include <stddef.h>

#include "spatial/brick.h"

/* Points of a brick's surface where halves of its neighbours have nodes that it has not. */
enum { HANGING_POINTS = 72 };

/* The p-th of them in shares 0 ... 1 of the brick. */
void hanging_point(int p, double at[3]);

struct hanging {
    size_t nodes;
    struct hanging_on {
        unsigned char count; /* 0: free */
        unsigned char level; /* of the brick that it hangs on */
        size_t masters[BRICK_NODES];
        double weights[BRICK_NODES];
    } * on; /* [nodes] */
};

/* False: no memory. */
bool hanging_create(size_t nodes, struct hanging *hanging);
void hanging_free(struct hanging *hanging);

/* A node that lies at `at` on the surface of a brick of that level; the coarsest brick counts. */
void hanging_add(struct hanging *hanging, size_t node, unsigned level,
                 const size_t nodes[BRICK_NODES], const double at[3]);

/* Lists for each node the free ones that it hangs on: first[nodes + 1] and what it points into, the
 * caller's to free. False: no memory. */
bool hanging_resolve(const struct hanging *hanging, size_t **first, size_t **masters,
                     double **weights);

#endif
