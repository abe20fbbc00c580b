/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/lcp.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/linear.h"

/* Tableau of w - m z - 1 z0 = q: n rows; columns w (n), z (n), z0, q. (Cottle, Pang, Stone, The
 * Linear Complementarity Problem, algorithm 4.4.5 and section 4.9.) */
struct tableau {
    size_t n, width;
    double *cell;
    size_t *basis; /* variable of each row: 0..n-1 w, n..2n-1 z, 2n z0 */
    /* room for the final basis: its z, their matrix, the right-hand side */
    size_t *list;
    double *a, *b;
};

static double *lcp_row_of(const struct tableau *t, size_t i)
{
    return t->cell + i * t->width;
}

static bool tableau_create(struct tableau *t, size_t n, const double *m, const double *q)
{
    t->n = n;
    t->width = 2 * n + 2;
    t->cell = calloc(n * (t->width + n + 1), sizeof *t->cell);
    t->basis = calloc(2 * n, sizeof *t->basis);
    if (!t->cell || !t->basis)
        return false;
    t->list = t->basis + n;
    t->a = t->cell + n * t->width;
    t->b = t->a + n * n;
    for (size_t i = 0; i < n; i++) {
        double *row = lcp_row_of(t, i);
        row[i] = 1.0;
        for (size_t j = 0; j < n; j++)
            row[n + j] = -m[i * n + j];
        row[n + i] -= 1e-10 * m[i * n + i];
        row[2 * n] = -1.0;
        row[2 * n + 1] = q[i];
        t->basis[i] = i;
    }
    return true;
}

static void pivot(struct tableau *t, size_t pivot_row, size_t column)
{
    double *p = lcp_row_of(t, pivot_row);
    double inverse = 1.0 / p[column];
    for (size_t k = 0; k < t->width; k++)
        p[k] *= inverse;
    for (size_t i = 0; i < t->n; i++) {
        double *row = lcp_row_of(t, i);
        double factor = row[column];
        if (i == pivot_row || factor == 0.0)
            continue;
        for (size_t k = 0; k < t->width; k++)
            row[k] -= factor * p[k];
        row[column] = 0.0;
    }
    t->basis[pivot_row] = column;
}

/* -1, 0, 1 by (q, inverse basis) of row a over its entry against row b over its. */
static int compare_ratio(const struct tableau *t, size_t a, size_t b, size_t column)
{
    const double *ra = lcp_row_of(t, a);
    const double *rb = lcp_row_of(t, b);
    for (size_t k = 0; k <= t->n; k++) {
        size_t at = k == 0 ? t->width - 1 : k - 1;
        double x = ra[at] / ra[column];
        double y = rb[at] / rb[column];
        if (x != y)
            return x < y ? -1 : 1;
    }
    return 0;
}

/* Row that leaves when `column` enters; n: none. z0 leaves as soon as it may. */
static size_t leaving_row(const struct tableau *t, size_t column)
{
    size_t best = t->n;
    double largest = 0.0;
    for (size_t i = 0; i < t->n; i++)
        largest = fmax(largest, fabs(lcp_row_of(t, i)[column]));
    for (size_t i = 0; i < t->n; i++) {
        if (!(lcp_row_of(t, i)[column] > 1e-13 * largest))
            continue;
        int order = best == t->n ? -1 : compare_ratio(t, i, best, column);
        if (order < 0 || (order == 0 && t->basis[i] == 2 * t->n))
            best = i;
    }
    return best;
}

static bool lemke(struct tableau *t)
{
    size_t n = t->n;
    /* z0 enters where q is most negative; nothing to do where none is */
    size_t first = 0;
    for (size_t i = 1; i < n; i++)
        if (lcp_row_of(t, i)[t->width - 1] < lcp_row_of(t, first)[t->width - 1])
            first = i;
    if (lcp_row_of(t, first)[t->width - 1] >= 0.0)
        return true;
    /* the complement of the variable that left enters, until z0 leaves */
    size_t left = t->basis[first];
    pivot(t, first, 2 * n);
    for (size_t i = 0; i < 50 * n + 100; i++) {
        size_t column = left < n ? left + n : left - n;
        size_t row = leaving_row(t, column);
        if (row == n)
            return false;
        left = t->basis[row];
        pivot(t, row, column);
        if (left == 2 * n)
            return true;
    }
    return false;
}

/* Solves the final basis again, without the tableau's rounding: m_BB z_B = -q_B with the raised
 * diagonal, then refinement without the raise, which would falsify the large impulses of
 * near-singular groups. Where the basis is singular the tableau's values stay. */
static void lcp_polish(const struct tableau *t, const double *m, const double *q, double *z)
{
    size_t n = t->n;
    size_t *list = t->list;
    double *a = t->a;
    double *b = t->b;
    size_t count = 0;
    bool done = true;
    /* the basic z */
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++)
            if (t->basis[i] == n + j)
                list[count++] = j;
    /* solve, then correct by the residual of the true equations */
    for (int round = 0; done && round < 4; round++) {
        for (size_t i = 0; i < count; i++) {
            b[i] = -q[list[i]];
            for (size_t j = 0; j < count; j++) {
                double raise = i == j ? 1e-10 * m[list[i] * n + list[i]] : 0.0;
                a[i * count + j] = m[list[i] * n + list[j]] + raise;
                b[i] -= round ? m[list[i] * n + list[j]] * z[list[j]] : 0.0;
            }
        }
        done = linear_solve(count, a, b);
        for (size_t i = 0; done && i < count; i++)
            z[list[i]] = round ? z[list[i]] + b[i] : b[i];
    }
    for (size_t i = 0; done && i < count; i++)
        z[list[i]] = fmax(0.0, z[list[i]]);
}

/* Independent check: complementarity of the answer itself. */
static bool solves(size_t n, const double *m, const double *q, const double *z)
{
    double scale = 0.0;
    for (size_t i = 0; i < n; i++)
        scale = fmax(scale, fabs(q[i]));
    for (size_t i = 0; i < n; i++) {
        double w = q[i];
        for (size_t j = 0; j < n; j++)
            w += m[i * n + j] * z[j];
        double residual = fmin(w, m[i * n + i] * z[i]);
        if (!(fabs(residual) <= 1e-8 * scale))
            return false;
    }
    return true;
}

enum lcp_outcome lcp_solve(size_t n, const double *m, const double *q, double *z)
{
    struct tableau t = {0};
    bool created = tableau_create(&t, n, m, q);
    bool solved = created && lemke(&t);
    memset(z, 0, n * sizeof *z);
    for (size_t i = 0; solved && i < n; i++)
        if (t.basis[i] >= n && t.basis[i] < 2 * n)
            z[t.basis[i] - n] = fmax(0.0, lcp_row_of(&t, i)[t.width - 1]);
    if (solved)
        lcp_polish(&t, m, q, z);
    free(t.cell);
    free(t.basis);
    if (!created)
        return LCP_NO_MEMORY;
    return solved && solves(n, m, q, z) ? LCP_SOLVED : LCP_UNSOLVED;
}
