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
