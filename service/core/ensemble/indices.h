/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Influence of one input: Sobol indices, the share of the variance of y that it explains by itself
 * and with its interactions, each with a confidence interval; and where along it the answer is
 * smooth. */
#ifndef PERCUSS_ENSEMBLE_INDICES_H
#define PERCUSS_ENSEMBLE_INDICES_H

#include <stdbool.h>
#include <stddef.h>

#include "ensemble/interval.h"

/* A sample, by its place in the order of the points. */
struct indices_point {
    double x, y;
    size_t sample;
};

/* The samples that have both numbers (NAN: missing), by ascending x, of equal x at random, since
 * neighbours of a Sobol sequence are alike; and how many they are. `sorted` has room for `count`.
 * False: out of memory. */
bool indices_sort(const double *x, const double *y, size_t count, struct indices_point *sorted,
                  size_t *kept);

/* A sample solved again with this input alone drawn anew (y NAN: it was refused). */
struct indices_row {
    size_t sample;
    double x, y;
};

/* Sample i belongs to the independent replicate i mod R (1: plain random points). */
struct indices_data {
    size_t count; /* of all samples */
    const struct indices_point *sorted;
    size_t kept; /* in `sorted` */
    size_t replicates;
    size_t row_count; /* 0: no total index */
    const struct indices_row *rows;
    double level; /* of confidence */
};

/* NAN: too few values, or none differ.
 *
 * First order, Var(E[y|x])/Var(y): 1 - the variance that is left within classes of some 8
 * neighbours in x, over all of it. Variation of y within a class counts as not explained. 0 where
 * chance makes it negative.
 *
 * Total, E[Var(y|all others)]/Var(y), after Jansen (1999) with the class means g(x) of the samples
 * as control variate. For any g, as x' is drawn independently of all others,
 *
 *     E[(y' - y)^2]/2 = Var(y) - E[(y - g(x))^2] + E[(y' - g(x') - y + g(x))^2]/2,
 *
 * where the samples, which are many, tell the first two terms, and the rows only the interactions
 * of x with others.
 *
 * The total index is never less than the first-order one. Where chance puts the estimates the other
 * way round, both are their mean, weighted with their variances: the most likely values in the
 * right order (pooled adjacent violators). */
struct indices {
    double first_order, total;
    struct interval first_bounds, total_bounds;
    double noise; /* an input without influence stays below in 95 % of all ensembles */
};

/* False: out of memory. */
bool indices_find(const struct indices_data *data, struct indices *indices);

/* Where along an input the answer is smooth: from the samples alone, for any sampling. */

/* y along x in one of equal parts of the range of x. */
struct influence_part {
    double low, high; /* of x */
    size_t count;
    double mean, deviation; /* of y */
    double local; /* standard deviation of y that is left when x is known to `resolution`: of two
                     values that far apart, their root mean square difference over sqrt 2; NAN: the
                     samples are not that dense */
    bool chaotic; /* that is more than half of the deviation of all values */
};

/* Fills `parts`; `resolution` of x. */
void influence_parts(const struct indices_point *sorted, size_t count, double resolution,
                     struct influence_part *parts, size_t part_count);

#endif
