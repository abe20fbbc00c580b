/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stiffness and mass of a mesh, consistent: degree of freedom 3 i + k moves node i along axis k. */
#ifndef PERCUSS_MESH_MATRICES_H
#define PERCUSS_MESH_MATRICES_H

#include <stdint.h>

#include "mesh/solid_mesh.h"

/* ---- symmetric sparse matrices ---- */

/* The upper triangle by rows: entry (i, column[p]) is value[p] for start[i] <= p < start[i + 1],
 * columns ascending from i on. A diagonal entry may be missing: it is zero. Owns its arrays. */
struct sparse {
    size_t n;
    size_t *start;    /* [n + 1] */
    uint32_t *column; /* [start[n]] */
    double *value;
};

/* Entries anywhere in the matrix, in any order, as files list them: one of (i, j) and (j, i), or
 * both, equal, with `both` set. Entries of one place add up. False: no memory. */
struct sparse_entry {
    uint32_t row, column;
    double value;
};
bool sparse_from_entries(struct sparse *matrix, size_t n, size_t count,
                         const struct sparse_entry *entries, bool both);

/* y = A x for `count` vectors, one after the other, each of n. */
void sparse_multiply(const struct sparse *matrix, size_t count, const double *x, double *y);

/* y^T A x */
double sparse_product(const struct sparse *matrix, const double *x, const double *y);

/* Removes the rows and columns of held degrees of freedom, except the diagonal with
 * `keep_diagonal`: a solution is zero there if the right-hand side is. */
void sparse_hold(struct sparse *matrix, const bool *held, bool keep_diagonal);

void sparse_free(struct sparse *matrix);

/* ---- stiffness and mass ---- */

struct matrices {
    struct sparse stiffness, mass; /* N/m, kg; held degrees of freedom have only their diagonal of
                                      the stiffness: see sparse_hold */
    bool *held;                    /* [3 node_count]; NULL: none is */
    const struct solid_mesh *mesh; /* borrowed: their mesh; NULL: read from a file */
};

/* Linear elastic, each part of its material, with the masses on nodes. PERCUSS_BAD_REQUEST: a node
 * belongs to no element, or the mesh has too many; PERCUSS_INTERNAL without memory. */
enum percuss_status matrices_make(const struct solid_mesh *mesh, struct matrices *matrices,
                                  struct fault *fault);

/* Holds all three directions of these nodes. PERCUSS_INTERNAL without memory. */
enum percuss_status matrices_hold(struct matrices *matrices, const struct mesh_set *set,
                                  struct fault *fault);

void matrices_free(struct matrices *matrices);

#endif
