/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/yield_rate.h"

#include <math.h>

double yield_rate_factor(const struct yield_rate *stated, double rate)
{
    if (!yield_rate_is_stated(stated))
        return 1.0;
    double ratio = rate / stated->reference;
    if (stated->exponent > 0.0)
        return 1.0 + pow(ratio, 1.0 / stated->exponent);
    return ratio > 1.0 ? 1.0 + stated->coefficient * log(ratio) : 1.0;
}

double yield_rate_sensitivity(const struct yield_rate *stated, double rate)
{
    double factor = yield_rate_factor(stated, rate);
    return stated->exponent > 0.0 ? (factor - 1.0) / (factor * stated->exponent)
                                  : stated->coefficient / factor;
}

double yield_rate_at(const struct yield_rate *stated, double raise, double *slope)
{
    if (stated->exponent > 0.0) {
        double power = stated->reference * pow(raise, stated->exponent - 1.0);
        *slope = stated->exponent * power;
        return power * raise;
    }
    double rate = stated->reference * exp(raise / stated->coefficient);
    *slope = rate / stated->coefficient;
    return rate;
}
