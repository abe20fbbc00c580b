/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How many failures chance explains. */
#ifndef PERCUSS_TEST_ESTIMATES_ODDS_H
#define PERCUSS_TEST_ESTIMATES_ODDS_H

#include <math.h>
#include <stddef.h>

/* Chance of more than `failures` among `count` independent trials that fail with `rate` each. */
static inline double odds_of_more(size_t failures, size_t count, double rate)
{
    double at_most = 0.0;
    for (size_t k = 0; k <= failures && k <= count; k++)
        at_most += exp(lgamma((double)count + 1.0) - lgamma((double)k + 1.0) -
                       lgamma((double)(count - k) + 1.0) + (double)k * log(rate) +
                       (double)(count - k) * log1p(-rate));
    return fmax(0.0, 1.0 - at_most);
}

/* The fewest failures that no more than `chance` of all draws exceed. */
static inline size_t odds_allow(size_t count, double rate, double chance)
{
    size_t failures = 0;
    while (failures < count && odds_of_more(failures, count, rate) > chance)
        failures++;
    return failures;
}

#endif
