/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/sparse.h"

#include <stdlib.h>
#include <string.h>

static int by_place(const void *left, const void *right)
{
    const struct sparse_entry *a = left, *b = right;
    if (a->row != b->row)
        return a->row < b->row ? -1 : 1;
    return a->column < b->column ? -1 : a->column > b->column;
}

/* The entries that count, turned to the upper triangle, sorted; returns how many. */
static size_t upper_entries(size_t count, const struct sparse_entry *entries, bool both,
                            struct sparse_entry *upper)
{
    size_t kept = 0;
    for (size_t e = 0; e < count; e++) {
        struct sparse_entry entry = entries[e];
        if (entry.row > entry.column) {
            if (both)
                continue;
            entry.row = entries[e].column;
            entry.column = entries[e].row;
        }
        upper[kept++] = entry;
    }
    qsort(upper, kept, sizeof *upper, by_place);
    return kept;
}

bool sparse_from_entries(struct sparse *matrix, size_t n, size_t count,
                         const struct sparse_entry *entries, bool both)
{
    struct sparse_entry *upper = malloc((count + 1) * sizeof *upper);
    *matrix = (struct sparse){.n = n, .start = calloc(n + 1, sizeof *matrix->start)};
    matrix->column = malloc((count + 1) * sizeof *matrix->column);
    matrix->value = malloc((count + 1) * sizeof *matrix->value);
    bool fine = upper && matrix->start && matrix->column && matrix->value;
    size_t filled = 0, kept = fine ? upper_entries(count, entries, both, upper) : 0;
    for (size_t e = 0; e < kept; e++) {
        /* the same place again adds up */
        if (e > 0 && by_place(&upper[e - 1], &upper[e]) == 0) {
            matrix->value[filled - 1] += upper[e].value;
            continue;
        }
        matrix->column[filled] = upper[e].column;
        matrix->value[filled++] = upper[e].value;
        matrix->start[upper[e].row + 1]++;
    }
    for (size_t i = 0; fine && i < n; i++)
        matrix->start[i + 1] += matrix->start[i];
    free(upper);
    if (!fine)
        sparse_free(matrix);
    return fine;
}

void sparse_multiply(const struct sparse *matrix, size_t count, const double *x, double *y)
{
    size_t n = matrix->n;
    memset(y, 0, count * n * sizeof *y);
    for (size_t c = 0; c < count; c++, x += n, y += n)
        for (size_t i = 0; i < n; i++) {
            double sum = 0.0, here = x[i];
            size_t p = matrix->start[i], end = matrix->start[i + 1];
            /* the diagonal once, anything else for both triangles */
            if (p < end && matrix->column[p] == i)
                sum = matrix->value[p++] * here;
            for (; p < end; p++) {
                size_t j = matrix->column[p];
                sum += matrix->value[p] * x[j];
                y[j] += matrix->value[p] * here;
            }
            y[i] += sum;
        }
}

double sparse_product(const struct sparse *matrix, const double *x, const double *y)
{
    double total = 0.0;
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++) {
            size_t j = matrix->column[p];
            total += matrix->value[p] * (i == j ? x[i] * y[i] : x[i] * y[j] + x[j] * y[i]);
        }
    return total;
}

void sparse_hold(struct sparse *matrix, const bool *held, bool keep_diagonal)
{
    size_t filled = 0, p = 0;
    for (size_t i = 0; i < matrix->n; i++) {
        size_t end = matrix->start[i + 1];
        for (matrix->start[i] = filled; p < end; p++) {
            size_t j = matrix->column[p];
            if (i == j ? held[i] && !keep_diagonal : held[i] || held[j])
                continue;
            matrix->column[filled] = (uint32_t)j;
            matrix->value[filled++] = matrix->value[p];
        }
    }
    matrix->start[matrix->n] = filled;
}

void sparse_free(struct sparse *matrix)
{
    free(matrix->start);
    free(matrix->column);
    free(matrix->value);
    *matrix = (struct sparse){0};
}
