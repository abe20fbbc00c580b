/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where along an input the answer is smooth: from the samples alone, for any sampling. NAN: a value
 * is missing. */
#ifndef PERCUSS_ENSEMBLE_INFLUENCE_H
#define PERCUSS_ENSEMBLE_INFLUENCE_H

#include <stdbool.h>
#include <stddef.h>

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
