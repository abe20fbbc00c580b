/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specification of an ensemble: its uncertain inputs and how they are sampled. */
#ifndef PERCUSS_ENSEMBLE_SPEC_H
#define PERCUSS_ENSEMBLE_SPEC_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "ensemble/sampling.h"
#include "solve/request.h"

/* An uncertain number of an impact: its quantity, its body and its distribution. */

/* speed: at which the contact approaches, m/s. direction: angle of the approach from the contact's
 * normal, rad. model-force, -compliance, -yield, -friction: error of the models, of all contacts,
 * in standard deviations (solve/model_deviation.h; of the stated coefficients of friction,
 * solve/request.h). friction: the contact's coefficient. site: place of the contact along a rod or
 * beam, 0 .. 1. The others: of a body; scale: of a mesh. */
#define INPUT_QUANTITY_LIST(X)                                                                     \
    X(SPEED, "speed")                                                                              \
    X(DIRECTION, "direction")                                                                      \
    X(MODEL_FORCE, "model-force")                                                                  \
    X(MODEL_COMPLIANCE, "model-compliance")                                                        \
    X(MODEL_YIELD, "model-yield")                                                                  \
    X(MODEL_FRICTION, "model-friction")                                                            \
    X(FRICTION, "friction")                                                                        \
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
           quantity == INPUT_MODEL_YIELD || quantity == INPUT_MODEL_FRICTION;
}

/* PERCUSS_OK or BAD_REQUEST, "inputs[index].field: value: must be ...". */
enum percuss_status input_check(const struct ensemble_input *input, size_t index,
                                struct fault *fault);

/* The quantile function: the value at probability u, 0 < u < 1, of the truncated distribution. */
double input_value(const struct ensemble_input *input, double u);

/* Probability of the distribution that the truncation takes away. */
double input_truncated(const struct ensemble_input *input);

enum {
    ENSEMBLE_MAX_INPUTS = SAMPLING_MAX_DIMENSIONS,
    ENSEMBLE_MAX_SAMPLES = 2000000,
    ENSEMBLE_MAX_QUANTILES = 64,
    ENSEMBLE_MAX_BINS = 1000,
    ENSEMBLE_MAX_VALUES = 100000 /* of a list */
};

/* Everything it points to is borrowed. */
struct ensemble_spec {
    const struct body_set *catalogue;
    const struct contact_table_source *tables; /* NULL: none */
    const struct solve_request *request;       /* the impact; the inputs replace numbers of it */
    size_t contact;                            /* index of the observed contact */
    size_t input_count;
    const struct ensemble_input *inputs;
    size_t correlation_count;
    const struct copula_pair *correlations; /* indices into inputs */
    enum sampling_method sampling;
    uint64_t samples; /* at most; 0: the values of the lists in their order, each once */
    uint64_t seed;
    double half_width;          /* stop when the mean's interval is within; 0: never */
    double quantile_half_width; /* and those of all quantiles; 0: not checked */
    size_t quantile_count;
    const double *quantiles; /* probabilities */
    size_t bins;             /* 0: the default */
    bool list_tangential;    /* samples are listed with their tangential results */
};

/* PERCUSS_OK or BAD_REQUEST with the field, its value and its allowed range. solve() judges the
 * request. */
enum percuss_status spec_check(const struct ensemble_spec *spec, struct fault *fault);

/* A table belongs to materials to the last bit: BAD_REQUEST for inputs that change one while
 * `table` is asked for. */
enum percuss_status spec_check_tables(const struct ensemble_spec *spec, struct fault *fault);

/* Whether an input is drawn, rather than a constant or a list walked through in order. */
bool spec_is_drawn(const struct ensemble_spec *spec, size_t input);

/* Whether some input changes a body or a place, not only velocities. */
bool spec_changes_scene(const struct ensemble_spec *spec);
bool spec_changes_bodies(const struct ensemble_spec *spec);

#endif
