/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Symmetric sparse matrices. */
#ifndef PERCUSS_MESH_SPARSE_H
#define PERCUSS_MESH_SPARSE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The upper triangle by rows: entry (i, column[p]) is value[p] for start[i] <= p < start[i + 1],
 * columns ascending from i on. A diagonal entry may be missing: it is zero. Owns its arrays. */
struct sparse {
    size_t n;
    size_t *start;    /* [n + 1] */
    uint32_t *column; /* [start[n]] */
    double *value;
};

/* Entries anywhere in the matrix, in any order, as files list them: of (i, j) and (j, i) one, or
 * both with `both` set, each then equal. Entries of one place add up. False: no memory. */
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

/* Takes the rows and columns of held degrees of freedom out, but for the diagonal where
 * `keep_diagonal`: what remains solves for zero there when the right-hand side is. */
void sparse_hold(struct sparse *matrix, const bool *held, bool keep_diagonal);

void sparse_free(struct sparse *matrix);

#endif
