/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specification of an ensemble. */
#ifndef PERCUSS_ENSEMBLE_SPEC_H
#define PERCUSS_ENSEMBLE_SPEC_H

#include "ensemble/copula.h"
#include "ensemble/input.h"
#include "ensemble/sampling.h"
#include "solve/request.h"

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
