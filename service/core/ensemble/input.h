/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* An uncertain number of an impact: its quantity, its body and its distribution. */
#ifndef PERCUSS_ENSEMBLE_INPUT_H
#define PERCUSS_ENSEMBLE_INPUT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

/* speed: at which the contact approaches, m/s. direction: angle of the approach from the contact's
 * normal, rad. model-force, -compliance, -yield: error of the models, of all contacts, in standard
 * deviations (solve/model_deviation.h). site: place of the contact along a rod or beam, 0 .. 1. The
 * others: of a body; scale: of a mesh. */
#define INPUT_QUANTITY_LIST(X)                                                                     \
    X(SPEED, "speed")                                                                              \
    X(DIRECTION, "direction")                                                                      \
    X(MODEL_FORCE, "model-force")                                                                  \
    X(MODEL_COMPLIANCE, "model-compliance")                                                        \
    X(MODEL_YIELD, "model-yield")                                                                  \
    X(SITE, "site")                                                                                \
    X(YOUNG, "young")                                                                              \
    X(POISSON, "poisson")                                                                          \
    X(DENSITY, "density")                                                                          \
    X(RADIUS, "radius")                                                                            \
    X(YIELD, "yield")                                                                              \
    X(DAMPING, "damping")                                                                          \
    X(SCALE, "scale")
#define INPUT_QUANTITY_MEMBER(name, text) INPUT_##name,
enum input_quantity { INPUT_QUANTITY_LIST(INPUT_QUANTITY_MEMBER) INPUT_QUANTITY_COUNT };

/* The numbers of DISTRIBUTION_* on the wire. */
enum distribution {
    DISTRIBUTION_IS_CONSTANT,
    DISTRIBUTION_IS_UNIFORM,
    DISTRIBUTION_IS_NORMAL,
    DISTRIBUTION_IS_LOG_NORMAL,
    DISTRIBUTION_IS_LIST,
    DISTRIBUTION_KINDS
};

struct ensemble_input {
    enum input_quantity quantity;
    size_t body; /* index into the request's bodies; for the contact's quantities 0 */
    enum distribution distribution;
    double first, second; /* constant: value; uniform: range; normal and log-normal: mean and
                             standard deviation of the value (before it is truncated) */
    double lower, upper;  /* truncation; NAN: only the limits of the quantity */
    const double *values; /* a list's; borrowed */
    size_t value_count;
};

const char *input_quantity_name(unsigned quantity);
const char *distribution_name(unsigned distribution);

/* By its name, or "at" for a site; INPUT_QUANTITY_COUNT: no such name. */
enum input_quantity input_quantity_find(const char *name);

/* Whether it belongs to a body rather than to the contact. */
bool input_is_of_body(enum input_quantity quantity);

/* Whether it shifts the models. */
static inline bool input_is_of_model(enum input_quantity quantity)
{
    return quantity == INPUT_MODEL_FORCE || quantity == INPUT_MODEL_COMPLIANCE ||
           quantity == INPUT_MODEL_YIELD;
}

/* PERCUSS_OK or BAD_REQUEST, "inputs[index].field: value: must be ...". */
enum percuss_status input_check(const struct ensemble_input *input, size_t index,
                                struct fault *fault);

/* The quantile function: the value at probability u, 0 < u < 1, of the truncated distribution. */
double input_value(const struct ensemble_input *input, double u);

/* Probability of the distribution that the truncation takes away. */
double input_truncated(const struct ensemble_input *input);

#endif
