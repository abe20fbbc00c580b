/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Shape of a distribution of the restitution within its possible range. */
#ifndef PERCUSS_ENSEMBLE_SHAPE_H
#define PERCUSS_ENSEMBLE_SHAPE_H

#include <stdbool.h>

#include "ensemble/summary.h"

/* Where a quantity can lie; infinite: unbounded. */
struct shape_range {
    double low, high;
};

/* mean -+ sigmas x deviation as the paper draws it, and the interval between the quantiles that
 * enclose as much of the sample as a normal distribution has within it. */
struct sigma_interval {
    double sigmas;
    double low, high;
    double covered;    /* share of the sample inside */
    double unphysical; /* share of its length where no value can be */
    double quantile_low, quantile_high;
};
struct sigma_interval shape_sigma_interval(const double *sorted, const struct moments *moments,
                                           double sigmas, const struct shape_range *range);

/* A Beta distribution on a range of possible values, by its moments. */
struct beta_fit {
    double low, high;
    double alpha, beta; /* NAN: the moments are not those of any Beta distribution, or no range */
    double distance;    /* Kolmogorov-Smirnov, largest difference of the distribution functions */
    double p_value;     /* asymptotic; too large as the parameters were fitted, so that a small one
                           refuses the fit for certain */
};
struct beta_fit shape_fit_beta(const double *sorted, const struct moments *moments,
                               const struct shape_range *range);

/* P(D > d) of the Kolmogorov-Smirnov distance of n values from a given distribution, asymptotic
 * with Stephens's correction (1970). */
double shape_kolmogorov_p(double distance, double n);

#endif
