/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Steps of linear vibration M u'' + K u = f by collocation at two places with a matrix of one pair
 * of complex eigenvalues: one complex solution is a step. Radau's (places 1/3, 1; third order)
 * follows modes too stiff for the step statically and is made for contact; Gauss's (fourth order)
 * keeps energy to rounding and is made for free flight. Hairer, Wanner: Solving Ordinary
 * Differential Equations II, section IV.8. */
#ifndef PERCUSS_SPATIAL_RATIONAL_H
#define PERCUSS_SPATIAL_RATIONAL_H

#include <complex.h>

enum rational_rule { RATIONAL_RADAU, RATIONAL_GAUSS };

/* With s = 1 / (pole h)^2: (K + s M) p = s M (u0 + pole h v0) + start f0 + end f1 for forces that
 * go linearly from f0 to f1, q = (p - u0) / (pole h), then u1 = keep u0 + 2 Re(weight p),  v1 =
 * keep v0 + 2 Re(weight q). */
struct rational {
    double complex pole, weight, start, end;
    double keep;
};

struct rational rational_make(enum rational_rule rule);

#endif
