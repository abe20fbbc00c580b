/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Fits parameters of a model to measured impacts by their robust quantities: the impulse and the
 * duration of the first sub-impact and the start of the second. The restitution of a sequence of
 * sub-impacts is chaotic in the parameters and takes no part. */
#ifndef PERCUSS_MEASURED_CALIBRATION_H
#define PERCUSS_MEASURED_CALIBRATION_H

#include "fit.h"
#include "impact.h"

enum { QUANTITY_FIRST_IMPULSE, QUANTITY_FIRST_DURATION, QUANTITY_SECOND_START, QUANTITIES };

/* "impulse of the first sub-impact", ... */
const char *quantity_name(int quantity);

struct calibration_problem {
    const struct measured_set *set;
    size_t parameters;
    /* Fills twins[i], the impacts as the model has them with these parameters (in units of their
     * size) and all speeds times `faster`. False stops the calibration. */
    bool (*simulate)(void *context, const double *x, double faster, struct measured_impact *twins);
    void *context;
    double noise; /* relative standard deviation of a measured quantity to start with */
};

struct calibration {
    struct fit fit;
    size_t known[QUANTITIES]; /* readings of each quantity */
    size_t used[QUANTITIES];  /* those that are fitted */
    double noise[QUANTITIES]; /* relative standard deviation of the residuals */
};

/* Starts from calibration->fit.x. Three to six rounds: each weighs a quantity by the scatter that
 * the round before left, and leaves out readings that the model does not have near by (a sub-impact
 * that is born or lost within 2 % of a parameter, or within two standard deviations of the speed)
 * and readings off by more than four standard deviations. False: simulate failed, or too few
 * readings (then `known` says how many), or out of memory. */
bool calibration_solve(const struct calibration_problem *problem, struct calibration *calibration);

#endif
