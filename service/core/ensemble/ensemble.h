/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many impacts with uncertain inputs. Sample i is a function of the request, the seed and i alone:
 * any worker may solve any of them in any order, and the report, made from all of them in order, is
 * the same to the bit. No threads here: the caller has them. */
#ifndef PERCUSS_ENSEMBLE_ENSEMBLE_H
#define PERCUSS_ENSEMBLE_ENSEMBLE_H

#include "ensemble/spec.h"
#include "solve/solution.h"

/* Outcome of one impact. */
struct ensemble_sample {
    double restitution, impulse, end_time, peak_force; /* NAN where it was refused */
    double compression;                                /* impulse that stops the approach, N s */
    double tangential[2]; /* impulses on body a, N s; NAN where it was refused */
    double tangential_restitution, restitution_kinematic;
    uint16_t sub_impacts, significant;
    uint32_t warnings;      /* 1 << enum warning_kind of each */
    uint32_t status;        /* enum percuss_status */
    uint32_t contact_model; /* enum percuss_contact_model */
};

static inline bool ensemble_has_result(enum percuss_status status)
{
    return status == PERCUSS_OK || status == PERCUSS_TRUNCATED;
}

static inline bool ensemble_sample_has_result(const struct ensemble_sample *sample)
{
    return ensemble_has_result((enum percuss_status)sample->status);
}

/* How the one model for all samples was chosen: some pilot samples are solved by the full accuracy
 * search, and it is the coarsest model that loses none of them: a pilot that agrees with the finest
 * model within half of the tolerance, or within all of it, still does. */
struct ensemble_model {
    struct solution_model model;
    double tolerance;
    unsigned pilots, agreeing; /* within the tolerance */
};

struct ensemble {
    struct ensemble_spec spec; /* borrowed: its pointers must stay valid */
    struct sampling sampling;
    struct copula copula;
    size_t drawn[ENSEMBLE_MAX_INPUTS]; /* inputs that the dimensions belong to */
    uint64_t count;                    /* of samples, at most */
    struct ensemble_model model;
    bool has_friction;                       /* the contact, as stated or by an input */
    bool same_scene;                         /* inputs change velocities only */
    enum percuss_contact_model stated_model; /* that solve() used for the impact as it is stated */
};

void ensemble_release(struct ensemble *ensemble);

/* Values of all inputs, spec.input_count of them, from a point of the unit cube; lists that are
 * taken in order give their value `index`. */
void ensemble_values(const struct ensemble *ensemble, const double *point, uint64_t index,
                     double *values);

/* The inputs of sample `index` < count: spec.input_count values. */
void ensemble_inputs(const struct ensemble *ensemble, uint64_t index, double *values);

/* One of them: no other is computed where inputs are independent. */
double ensemble_input(const struct ensemble *ensemble, uint64_t index, size_t input);

#endif
