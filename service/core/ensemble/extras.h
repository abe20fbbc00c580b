/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbers of samples and extra solutions of an ensemble, and the place of each extra. */
#ifndef PERCUSS_ENSEMBLE_EXTRAS_H
#define PERCUSS_ENSEMBLE_EXTRAS_H

#include "ensemble/worker.h"

/* After `done` samples (their places in order, none missing) some more solutions tell how good they
 * are and the influence of each input; `ensemble_extras` is their number. */
uint64_t ensemble_extras(const struct ensemble *ensemble, uint64_t done);

/* Place of extra k: the sample, and the dimension drawn anew (SIZE_MAX: none). The samples are
 * drawn at random, as many of each replicate. */
struct ensemble_extra_place {
    uint64_t sample;
    size_t dimension;
};
struct ensemble_extra_place ensemble_extra_place(const struct ensemble *ensemble, uint64_t done,
                                                 uint64_t k);

/* Extra solution k. The first ones repeat samples with the full accuracy search, the others with
 * one input drawn anew. */
struct ensemble_extra {
    double restitution;   /* NAN: it was refused */
    double tangential[2]; /* impulses, N s; 0 without friction */
    double error;         /* that the search estimates; NAN where one input is new */
};
struct ensemble_extra ensemble_extra(struct ensemble_worker *worker, uint64_t done, uint64_t k);

/* Its inputs: spec.input_count values. */
void ensemble_extra_inputs(const struct ensemble *ensemble,
                           const struct ensemble_extra_place *place, double *values);

/* The next number of samples, beyond `done`, at which to ask whether they are enough. */
uint64_t ensemble_next_check(const struct ensemble *ensemble, uint64_t done);

#endif
