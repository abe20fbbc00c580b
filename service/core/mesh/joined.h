/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Disjoint sets as a forest in an array: the parent of an item is another item of its set, or
 * itself for the first of the set. */
#ifndef PERCUSS_MESH_JOINED_H
#define PERCUSS_MESH_JOINED_H

#include <stddef.h>

static inline void joined_begin(size_t *parent, size_t count)
{
    for (size_t i = 0; i < count; i++)
        parent[i] = i;
}

/* The first item of its set. */
static inline size_t joined_root(size_t *parent, size_t i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static inline void joined_unite(size_t *parent, size_t i, size_t j)
{
    size_t a = joined_root(parent, i), b = joined_root(parent, j);
    parent[a < b ? b : a] = a < b ? a : b;
}

#endif
