/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Yield stress that grows with the rate of strain, as a material states it. */
#ifndef PERCUSS_MODEL_YIELD_RATE_H
#define PERCUSS_MODEL_YIELD_RATE_H

#include <stdbool.h>

#include "base/fault.h"

/* Over that of a slow test it is
 *   1 + (rate/reference)^(1/exponent)       (Cowper and Symonds, 1957), with an exponent > 0, or
 *   1 + coefficient ln(rate/reference)      (Johnson and Cook, 1983), 1 below the reference,
 * and 1 where all is zero. */
struct yield_rate {
    double reference;   /* 1/s; 0: none is stated */
    double exponent;    /* 0: by the coefficient */
    double coefficient; /* 0: by the exponent */
};

/* Whether the yield stress of such a material depends on the rate. */
static inline bool yield_rate_is_stated(const struct yield_rate *stated)
{
    return stated->reference > 0.0;
}

/* Yield stress at a rate of strain (1/s) over that of a slow test; >= 1. */
double yield_rate_factor(const struct yield_rate *stated, double rate);

/* Slope of the factor's logarithm over that of the rate, 0 <= slope <= 1, where the stress depends
 * on the rate; up to the reference of a coefficient that just beyond it. */
double yield_rate_sensitivity(const struct yield_rate *stated, double rate);

/* The rate (1/s) at which that factor is 1 + raise, for a raise >= 0 of a yield stress that depends
 * on the rate: the reference for a raise of 0 by the coefficient. `slope`: its derivative. */
double yield_rate_at(const struct yield_rate *stated, double raise, double *slope);

#endif
