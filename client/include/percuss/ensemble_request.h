/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many impacts with uncertain inputs: the request. SI units. */
#ifndef PERCUSS_ENSEMBLE_REQUEST_H
#define PERCUSS_ENSEMBLE_REQUEST_H

#include <percuss/request.h>

enum {
    PERCUSS_MAX_INPUTS = 64,
    PERCUSS_MAX_CORRELATIONS = 256,
    PERCUSS_MAX_QUANTILES = 64,
    PERCUSS_MAX_SAMPLES = 2000000
};

#define PERCUSS_DISTRIBUTION_LIST(X)                                                               \
    X(CONSTANT, "constant")                                                                        \
    X(UNIFORM, "uniform")                                                                          \
    X(NORMAL, "normal")                                                                            \
    X(LOG_NORMAL, "log-normal")                                                                    \
    X(LIST, "list")
#define PERCUSS_SAMPLING_LIST(X)                                                                   \
    X(PLAIN, "plain")                                                                              \
    X(LATIN_HYPERCUBE, "latin-hypercube")                                                          \
    X(SOBOL, "sobol")
#define PERCUSS_DISTRIBUTION_MEMBER(name, text) PERCUSS_DISTRIBUTION_##name,
#define PERCUSS_SAMPLING_MEMBER(name, text)     PERCUSS_SAMPLING_##name,
enum percuss_distribution {
    PERCUSS_DISTRIBUTION_LIST(PERCUSS_DISTRIBUTION_MEMBER) PERCUSS_DISTRIBUTION_COUNT
};
enum percuss_sampling { PERCUSS_SAMPLING_LIST(PERCUSS_SAMPLING_MEMBER) PERCUSS_SAMPLING_COUNT };

struct percuss_input {
    char name[PERCUSS_ID_SIZE]; /* speed, direction; the models' errors, in standard deviations:
                                   model-force, model-compliance, model-yield, model-friction;
                                   friction; site, young, poisson, density, radius, yield, damping
                                   of a body */
    char body[PERCUSS_ID_SIZE]; /* its id; empty: of the contact */
    enum percuss_distribution distribution;
    double first, second; /* constant: value; uniform: range; others: mean and deviation */
    double lower, upper;  /* truncation; NAN: none */
    const double *values; /* a list's; borrowed */
    size_t value_count;
};

struct percuss_correlation {
    uint32_t first, second; /* indices into inputs */
    double coefficient;     /* of a Gaussian copula */
};

struct percuss_ensemble_request {
    uint64_t sequence; /* 0: the client counts */
    struct percuss_request scene;
    size_t input_count;
    struct percuss_input inputs[PERCUSS_MAX_INPUTS];
    size_t correlation_count;
    struct percuss_correlation correlations[PERCUSS_MAX_CORRELATIONS];
    enum percuss_sampling sampling;
    uint64_t samples; /* at most; 0: the values of the lists side by side, each once */
    uint64_t seed;
    double half_width;          /* stop when the mean's 95 % interval is within; 0: never */
    double quantile_half_width; /* and those of all quantiles; 0: not a condition */
    size_t quantile_count;      /* 0: a default set */
    double quantiles[PERCUSS_MAX_QUANTILES];
    uint32_t bins;     /* 0: a default number */
    uint32_t contact;  /* the one that is looked at */
    bool list_samples; /* also hand over every sample */
};

struct percuss_ensemble_progress {
    uint64_t done, samples;
    double mean, standard_deviation, half_width; /* of the restitution so far */
};

#endif
