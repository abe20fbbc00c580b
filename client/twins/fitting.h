/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Parameters of bodies from measured impacts. */
#ifndef PERCUSS_TWINS_FITTING_H
#define PERCUSS_TWINS_FITTING_H

#include "calibration.h"
#include "twin.h"

struct calibrate_parameter {
    enum percuss_parameter parameter;
    char body[PERCUSS_ID_SIZE]; /* of A or B */
    double start;               /* NAN: the catalogue's */
    double size;                /* unit of its changes in the fit */
    double value, half_width;   /* of the 95 % interval */
};

/* A fit under way; members above `result` are the caller's. */
struct fitting {
    const struct twin_question *question;
    const struct measured_set *set; /* complete */
    struct calibrate_parameter *parameters;
    size_t count;
    double noise;      /* relative standard deviation of a measured number to start with */
    struct twin *list; /* [set->count] */
    struct twin_listener listener;
    enum percuss_result result; /* of the last asking */
};

/* Answers finer than they need to be otherwise, so that derivatives by differences are good. */
extern const double FITTING_TOLERANCE;

enum fitting_lack { FITTING_LACKS_NOTHING, FITTING_LACKS_PARAMETER, FITTING_LACKS_START };

/* Fills the start of each parameter: the given one, or the catalogue's. Where one lacks something,
 * *which is its index: the body has no such parameter, or there is nothing to start from (a factor
 * cannot start from 0). */
enum fitting_lack fitting_start(struct fitting *fitting, size_t *which);

/* Asks for the twins with these multiples of the parameters. */
enum percuss_result fitting_ask(struct fitting *fitting, const double *x, double faster);

/* Finds the values. False as calibration_solve; `result` says whether it was the asking. */
bool fitting_solve(struct fitting *fitting, struct calibration *calibration);

/* Whether the data tell the parameter: its interval is not as wide as half its value. */
bool fitting_determines(const struct calibrate_parameter *parameter);

#endif
