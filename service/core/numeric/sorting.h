/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many numbers in order, without comparisons: the time is proportional to their count. */
#ifndef PERCUSS_NUMERIC_SORTING_H
#define PERCUSS_NUMERIC_SORTING_H

#include <stdbool.h>
#include <stddef.h>

/* Sorts `count` numbers, none of them NAN, in ascending order; -0 becomes 0. `origin` (NULL: not
 * wanted) is sorted with them: equal numbers keep their order. False: out of memory, and nothing is
 * changed. */
bool sorting_ascend(double *values, size_t *origin, size_t count);

#endif
