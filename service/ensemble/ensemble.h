/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many impacts with uncertain inputs. Sample i is a function of the request, the seed and i alone:
 * any worker may solve any of them in any order, and the report, made from all of them in order, is
 * the same to the bit. No threads here: the caller has them. */
#ifndef PERCUSS_ENSEMBLE_ENSEMBLE_H
#define PERCUSS_ENSEMBLE_ENSEMBLE_H

#include "ensemble/spec.h"
#include "solve/repeat.h"

/* What one impact did. */
struct ensemble_sample {
    double restitution, impulse, end_time, peak_force; /* NAN where it was refused */
    uint16_t sub_impacts, significant;
    uint16_t warnings;     /* 1 << enum warning_kind of each */
    uint8_t status;        /* enum percuss_status */
    uint8_t contact_model; /* enum percuss_contact_model */
};

static inline bool ensemble_sample_has_result(const struct ensemble_sample *sample)
{
    return sample->status == PERCUSS_OK || sample->status == PERCUSS_TRUNCATED;
}

/* How the one model for all samples was chosen: some pilot samples are solved by the full accuracy
 * search, and it is the coarsest model that loses none of them: who agrees with the finest within
 * half of the tolerance, or within all of it, still does. */
struct ensemble_model {
    struct solution_model model;
    double tolerance;
    unsigned pilots, agreeing; /* within the tolerance */
};

struct ensemble {
    struct ensemble_spec spec; /* what it points to is the caller's and must stay */
    struct sampling sampling;
    struct copula copula;
    size_t drawn[ENSEMBLE_MAX_INPUTS]; /* inputs that the dimensions belong to */
    uint64_t count;                    /* of samples, at most */
    struct ensemble_model model;
    bool same_scene;                         /* inputs change velocities only */
    enum percuss_contact_model stated_model; /* that solve() used for the impact as it is stated */
};

struct ensemble_worker;
/* `watch` (NULL: nobody; copied) is asked about once a millisecond of a solution whether to go on.
 * BAD_REQUEST: an input that this impact cannot have; INTERNAL: out of memory. */
enum percuss_status ensemble_worker_create(struct ensemble_worker **worker,
                                           const struct ensemble *ensemble,
                                           const struct watch *watch, struct fault *fault);
void ensemble_worker_free(struct ensemble_worker *worker);

/* Checks the request and chooses the model, which takes some ten milliseconds, or seconds where
 * single impacts take long. PERCUSS_OK, or the refusal: of the ensemble, or of the impact as it is
 * stated; TIMEOUT where the watch (NULL: nobody), asked as above, stopped it. */
enum percuss_status ensemble_create(struct ensemble *ensemble, const struct ensemble_spec *spec,
                                    const struct watch *watch, struct fault *fault);
void ensemble_release(struct ensemble *ensemble);

/* The inputs of sample `index` < count: spec.input_count values. */
void ensemble_inputs(const struct ensemble *ensemble, uint64_t index, double *values);

/* Solves sample `index`; its status is TIMEOUT where the watch stopped it: it is not solved. The
 * message of a refusal goes to `fault` (NULL: nobody reads it). */
void ensemble_solve(struct ensemble_worker *worker, uint64_t index, struct ensemble_sample *sample,
                    struct fault *fault);

/* The warnings of the sample that the worker solved last. */
const struct warnings *ensemble_warnings(const struct ensemble_worker *worker);

/* After `done` samples (their places in order, none missing) some more solutions tell how good they
 * are and what each input does; `ensemble_extras` is their number. */
uint64_t ensemble_extras(const struct ensemble *ensemble, uint64_t done);

/* What extra k belongs to: the sample, and the dimension drawn anew (SIZE_MAX: none). The samples
 * are drawn at random, as many of each replicate. */
struct ensemble_extra_place {
    uint64_t sample;
    size_t dimension;
};
struct ensemble_extra_place ensemble_extra_place(const struct ensemble *ensemble, uint64_t done,
                                                 uint64_t k);

/* Extra solution k. The first ones repeat samples with the full accuracy search, the others with
 * one input drawn anew. */
struct ensemble_extra {
    double restitution; /* NAN: it was refused */
    double error;       /* that the search estimates; NAN where one input is new */
};
struct ensemble_extra ensemble_extra(struct ensemble_worker *worker, uint64_t done, uint64_t k);

/* Its inputs: spec.input_count values. */
void ensemble_extra_inputs(const struct ensemble *ensemble,
                           const struct ensemble_extra_place *place, double *values);

/* The next number of samples, beyond `done`, at which to ask whether they are enough. */
uint64_t ensemble_next_check(const struct ensemble *ensemble, uint64_t done);

#endif
