/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/rates.h"

#include <stdlib.h>
#include <time.h>

#include "numeric/dense.h"

double rates_clock(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* The products of `a` vectors with `b` others, all of the length n, again and again until they have
 * taken long enough to be told from noise. */
static double product_rate(size_t n, size_t a, size_t b, const double *values, double *products)
{
    static const double LONG_ENOUGH = 0.03;
    double start = rates_clock(), seconds = 0.0, operations = 0.0;
    while (seconds < LONG_ENOUGH) {
        dense_products((struct dense){n, a, values}, (struct dense){n, b, values}, products);
        operations += 2.0 * (double)n * (double)a * (double)b;
        seconds = rates_clock() - start;
    }
    return operations / seconds;
}

bool rates_measure(struct rates *rates)
{
    /* the thin one is of 32 MB */
    enum { SQUARE = 256, LENGTH = 65536, SET = 64, BLOCK = 8 };
    size_t count = (size_t)LENGTH * SET;
    double *values = malloc(count * sizeof *values);
    double *products = malloc((size_t)SQUARE * SQUARE * sizeof *products);
    bool fine = values && products;
    if (fine) {
        for (size_t i = 0; i < count; i++)
            values[i] = 1.0;
        rates->square = product_rate(SQUARE, SQUARE, SQUARE, values, products);
        rates->thin = product_rate(LENGTH, SET, BLOCK, values, products);
    }
    free(values);
    free(products);
    return fine;
}

/* Against times of MUMPS 5.5 and of sparse_multiply on the bodies of tests/bench/reduction.sh,
 * 1,400 to 47,000 unknowns: to a factor of 1.6 for those that take longer than a tenth of a second.
 * Fronts are smaller than the caches hold, and each entry of L is put in its place besides, by as
 * much time as so many operations of the thin rate. */
static const double FRONTS = 0.6, PLACED = 250.0;
/* of the thin rate: few columns, many columns, products with a sparse matrix */
static const double FEW = 0.75, MANY = 1.5, SPARSE = 0.45;
enum { FEW_COLUMNS = 16 };

double rates_factor(const struct rates *rates, const struct factor_cost *cost)
{
    return cost->operations / (FRONTS * rates->square) + PLACED * cost->entries / rates->thin;
}

/* all entries twice, each an addition and a product */
double rates_solution(const struct rates *rates, const struct factor_cost *cost, size_t together)
{
    return 4.0 * cost->entries / ((together < FEW_COLUMNS ? FEW : MANY) * rates->thin);
}

double rates_product(const struct rates *rates, size_t entries)
{
    return 4.0 * (double)entries / (SPARSE * rates->thin);
}
