/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Least squares for values at nodes that many faces share: rows of shape functions times these
 * values are to be what is known at points of the faces. */
#ifndef PERCUSS_REDUCE_EDGE_FIT_H
#define PERCUSS_REDUCE_EDGE_FIT_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/surface.h"

/* sum of shape[i] value[index[i]] = rest, so much weighed. */
struct edge_row {
    size_t count;
    size_t index[FACE_MOST_NODES];
    double shape[FACE_MOST_NODES];
    double rest, weight;
};

/* Starts empty, all 0; owns its rows. */
struct edge_fit {
    size_t count, room;
    struct edge_row *rows;
};

/* False: out of memory. */
bool edge_fit_add(struct edge_fit *fit, const struct edge_row *row);

/* The `count` values that fit best, from those there are, each of which weighs `own` itself: it
 * decides where the rows say nothing. By conjugate gradients; false: out of memory. */
bool edge_fit_solve(const struct edge_fit *fit, size_t count, double own, double *values);

void edge_fit_free(struct edge_fit *fit);

#endif
