/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Least squares: parameters that make residuals small, with confidence intervals, and whether the
 * data determine them. */
#ifndef PERCUSS_MEASURED_FIT_H
#define PERCUSS_MEASURED_FIT_H

#include <stdbool.h>
#include <stddef.h>

enum { FIT_PARAMETERS = 8 };

struct fit_problem {
    size_t parameters, residuals;
    /* Fills the residuals, in units of their standard deviation, at `x` (parameters in units of
     * their size, so that 1e-3 is a small change of each). False stops the fit. */
    bool (*evaluate)(void *context, const double *x, double *residuals);
    void *context;
    double difference; /* change of a parameter for a derivative */
    /* Residuals of one group share errors: group[i] below `groups`. The intervals then rest on the
     * scatter between groups only. NULL: all are independent and alike. */
    const size_t *group;
    size_t groups;
};

struct fit {
    double x[FIT_PARAMETERS];
    double deviation[FIT_PARAMETERS];  /* standard; INFINITY: the data say nothing */
    double half_width[FIT_PARAMETERS]; /* of the 95 % confidence interval */
    double correlation[FIT_PARAMETERS][FIT_PARAMETERS];
    double sum; /* of squared residuals */
    double freedom;
    unsigned evaluations;
};

/* Starts from fit->x and leaves the best there (Levenberg and Marquardt, by MINPACK). The intervals
 * come from the residuals that remain. False: evaluate failed, too few residuals, or out of
 * memory. */
bool fit_solve(const struct fit_problem *problem, struct fit *fit);

#endif
