/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Every process' share of a mesh's elements, which it assembles. */
#ifndef PERCUSS_REDUCE_MPI_SHARE_H
#define PERCUSS_REDUCE_MPI_SHARE_H

#include "mesh/matrices.h"

/* Owns its arrays. */
struct share {
    size_t node_count;        /* of the whole mesh */
    bool *held;               /* [3 node_count]; NULL: none */
    size_t *nodes;            /* the whole mesh's number of each node of the share */
    struct matrices matrices; /* of the share's elements, nothing held ... */
    bool borrowed;            /* ... or all there are, of no mesh, at the first process */
};

/* By all processes together: `whole` is the first one's, borrowed, NULL elsewhere. A process
 * without memory ends them all. */
void share_make(const struct matrices *whole, struct share *share);

void share_free(struct share *share);

#endif
