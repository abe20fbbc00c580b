/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/lagrange.h"

void lagrange_values(const double *place, size_t count, double s, double *value)
{
    for (size_t j = 0; j < count; j++) {
        value[j] = 1.0;
        for (size_t i = 0; i < count; i++)
            if (i != j)
                value[j] *= (s - place[i]) / (place[j] - place[i]);
    }
}

void lagrange_slopes(const double *place, size_t count, double s, double *slope)
{
    for (size_t j = 0; j < count; j++) {
        double product = 1.0, sum = 0.0;
        for (size_t i = 0; i < count; i++) {
            if (i == j)
                continue;
            double width = place[j] - place[i];
            sum = (sum * (s - place[i]) + product) / width;
            product *= (s - place[i]) / width;
        }
        slope[j] = sum;
    }
}
