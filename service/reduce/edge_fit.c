/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/edge_fit.h"

#include <stdlib.h>

/* Of what the gradient was at first, squared: far below what a flexibility is known to. */
static const double SETTLED = 1e-20;
/* Neighbours alone are coupled, so that far fewer steps settle it. */
enum { MOST_STEPS = 500 };

bool edge_fit_add(struct edge_fit *fit, const struct edge_row *row)
{
    if (fit->count == fit->room) {
        size_t room = 2 * fit->room + 64;
        struct edge_row *rows = realloc(fit->rows, room * sizeof *rows);
        if (!rows)
            return false;
        fit->rows = rows;
        fit->room = room;
    }
    fit->rows[fit->count++] = *row;
    return true;
}

void edge_fit_free(struct edge_fit *fit)
{
    free(fit->rows);
    *fit = (struct edge_fit){0};
}

/* product += A^T W A values */
static void multiply(const struct edge_fit *fit, const double *values, double *product)
{
    for (size_t r = 0; r < fit->count; r++) {
        const struct edge_row *row = &fit->rows[r];
        double sum = 0.0;
        for (size_t i = 0; i < row->count; i++)
            sum += row->shape[i] * values[row->index[i]];
        for (size_t i = 0; i < row->count; i++)
            product[row->index[i]] += row->weight * row->shape[i] * sum;
    }
}

static double dot(size_t count, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

bool edge_fit_solve(const struct edge_fit *fit, size_t count, double own, double *values)
{
    double *memory = calloc(3 * count + 1, sizeof *memory);
    double *residual = memory, *along = memory + count, *product = memory + 2 * count;
    if (!memory)
        return false;
    /* what the rows ask beyond the values that there are: own weights ask nothing yet */
    multiply(fit, values, product);
    for (size_t r = 0; r < fit->count; r++)
        for (size_t i = 0; i < fit->rows[r].count; i++)
            residual[fit->rows[r].index[i]] +=
                fit->rows[r].weight * fit->rows[r].shape[i] * fit->rows[r].rest;
    for (size_t i = 0; i < count; i++)
        along[i] = residual[i] -= product[i];
    double square = dot(count, residual, residual), enough = SETTLED * square;
    /* conjugate gradients on A^T W A + own I */
    for (int step = 0; step < MOST_STEPS && square > enough; step++) {
        for (size_t i = 0; i < count; i++)
            product[i] = own * along[i];
        multiply(fit, along, product);
        double length = square / dot(count, along, product), before = square;
        for (size_t i = 0; i < count; i++) {
            values[i] += length * along[i];
            residual[i] -= length * product[i];
        }
        square = dot(count, residual, residual);
        for (size_t i = 0; i < count; i++)
            along[i] = residual[i] + square / before * along[i];
    }
    free(memory);
    return true;
}
