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

/* A sample solved again with this input alone drawn anew. */
struct indices_row {
    size_t sample;
    double x, y;
};

/* Samples in the order of their points; sample i belongs to the independent replicate i mod R (1:
 * plain random points). NAN: a value is missing. */
struct indices_data {
    size_t count;
    const double *x, *y; /* [count] */
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

/* Where along an input the answer is smooth: from the samples alone, for any sampling. NAN: a value
 * is missing. */

/* A pair of numbers to be sorted by x. */
struct influence_pair {
    double x, y;
};

/* Drops pairs with a NAN and sorts the others by x. Returns how many they are. */
size_t influence_sort(struct influence_pair *pairs, size_t count);

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
void influence_parts(const struct influence_pair *sorted, size_t count, double resolution,
                     struct influence_part *parts, size_t part_count);

#endif
