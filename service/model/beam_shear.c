/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/beam.h"

#include <math.h>

/* Cowper 1966, J. Appl. Mech. 33, 335. */
double beam_shear_cowper_circle(double poisson)
{
    return 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson);
}

double beam_shear_cowper_rectangle(double poisson)
{
    return 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
}

/* Hutchinson 2001, J. Appl. Mech. 68, 87. */
double beam_shear_hutchinson_circle(double poisson)
{
    return 6.0 * (1.0 + poisson) * (1.0 + poisson) /
           (7.0 + 12.0 * poisson + 4.0 * poisson * poisson);
}

/* Sum over n >= 1 of (z - tanh z)/(n pi)^5 with z = n pi/t: the sums of z and of 1 have closed
 * forms (zeta(4), zeta(5)), and 1 - tanh z = 2/(exp(2z) + 1) falls geometrically. */
static double flexure_sum(double t)
{
    static const double zeta5 = 1.03692775514336992633;
    double sum = 1.0 / (90.0 * t) - zeta5 / pow(M_PI, 5.0);

    for (int n = 1; n < 10000; n++) {
        double term = 2.0 / ((exp(2.0 * n * M_PI / t) + 1.0) * pow(n * M_PI, 5.0));
        sum += term;
        if (term < 1e-17 * fabs(sum))
            break;
    }
    return sum;
}

/* k = -2(1+nu)/[9 C4/(4 a^5 b) + nu(1 - b^2/a^2)] for depth 2a and width 2b, with
 * C4 = (4/45) a^3 b (-12a^2 - 15 nu a^2 + 5 nu b^2)
 *      + sum 16 nu^2 b^5 (n pi a - b tanh(n pi a/b))/((n pi)^5 (1+nu)).
 * Written with t = b/a the terms of nu t^2 cancel. */
double beam_shear_hutchinson_rectangle(double poisson, double depth, double breadth)
{
    double t = breadth / depth;
    double warping = 36.0 * poisson * poisson * pow(t, 5.0) * flexure_sum(t) / (1.0 + poisson);

    return 2.0 * (1.0 + poisson) / (2.4 + 2.0 * poisson - warping);
}
