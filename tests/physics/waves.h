/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* d'Alembert's waves in an elementary rod: a force F on its free end moves it at F/Z, Z = rho c A,
 * and every return of the wave adds 2 F/Z of 2 L/c, 4 L/c, ... before. */
#ifndef PERCUSS_TEST_WAVES_H
#define PERCUSS_TEST_WAVES_H

#include <stddef.h>

/* Forces at the ends and middles of steps that divide the period, 2 L/c. */
struct wave_history {
    size_t per_period, count;
    double *force; /* [2 count + 1], every half step */
};

/* 2 sum_j F(t - j period)/Z at half step i: the velocity that came back. */
static inline double wave_returned(const struct wave_history *past, double impedance, size_t i)
{
    double sum = 0.0;
    size_t back = 2 * past->per_period;
    for (size_t at = i; at >= back; at -= back)
        sum += past->force[at - back];
    return 2.0 * sum / impedance;
}

#endif
