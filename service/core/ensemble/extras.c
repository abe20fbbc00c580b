/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/extras.h"

#include <math.h>

enum {
    VERIFIED = 200,
    SUBSTITUTED = 2000, /* samples with one input drawn anew, at most, for each input */
    LEAST_SUBSTITUTED = 32,
    FIRST_CHECK = 256
};

/* In whole replicates. */
static uint64_t complete(const struct ensemble *ensemble, uint64_t done)
{
    return done - done % ensemble->sampling.replicates;
}

static uint64_t verified(const struct ensemble *ensemble, uint64_t done)
{
    uint64_t most = complete(ensemble, done);
    return most < VERIFIED ? most : VERIFIED;
}

/* Sample k of those that are solved again. They are random: every n-th point of a Sobol sequence
 * lies in one part of the cube. */
static uint64_t chosen(const struct ensemble *ensemble, uint64_t done, uint64_t k)
{
    const struct random_stream stream = {ensemble->spec.seed, STREAM_CHOSEN};
    uint64_t replicates = ensemble->sampling.replicates, replicate = k % replicates;
    uint64_t key = random_bits(&stream, replicate, 0);
    return random_permute(key, k / replicates, done / replicates) * replicates + replicate;
}

/* Samples to be repeated with an input drawn anew: all of that within half the work so far. None
 * for a single input, which causes all of the variance, or for correlated inputs, which cannot
 * change alone. */
static uint64_t substituted(const struct ensemble *ensemble, uint64_t done)
{
    size_t dimensions = ensemble->sampling.dimensions;
    if (dimensions < 2 || ensemble->copula.factor)
        return 0;
    uint64_t each = complete(ensemble, done) / (2 * dimensions);
    each = each < SUBSTITUTED ? each : SUBSTITUTED;
    return each < LEAST_SUBSTITUTED ? 0 : each;
}

uint64_t ensemble_extras(const struct ensemble *ensemble, uint64_t done)
{
    return verified(ensemble, done) + substituted(ensemble, done) * ensemble->sampling.dimensions;
}

struct ensemble_extra_place ensemble_extra_place(const struct ensemble *ensemble, uint64_t done,
                                                 uint64_t k)
{
    uint64_t checks = verified(ensemble, done);
    if (k < checks)
        return (struct ensemble_extra_place){chosen(ensemble, done, k), SIZE_MAX};
    uint64_t each = substituted(ensemble, done);
    return (struct ensemble_extra_place){chosen(ensemble, done, (k - checks) % each),
                                         (size_t)((k - checks) / each)};
}

void ensemble_extra_inputs(const struct ensemble *ensemble,
                           const struct ensemble_extra_place *place, double *values)
{
    ensemble_inputs(ensemble, place->sample, values);
    if (place->dimension == SIZE_MAX)
        return;
    const struct random_stream stream = {ensemble->spec.seed, STREAM_SUBSTITUTES};
    size_t input = ensemble->drawn[place->dimension];
    values[input] = input_value(&ensemble->spec.inputs[input],
                                random_uniform(&stream, place->sample, place->dimension));
}

struct ensemble_extra ensemble_extra(struct ensemble_worker *worker, uint64_t done, uint64_t k)
{
    const struct ensemble *ensemble = worker_ensemble(worker);
    struct ensemble_extra_place place = ensemble_extra_place(ensemble, done, k);
    double values[ENSEMBLE_MAX_INPUTS];
    struct repeat_outcome outcome;
    ensemble_extra_inputs(ensemble, &place, values);
    enum percuss_status status = place.dimension == SIZE_MAX
                                     ? worker_search(worker, values, NULL, &outcome, NULL)
                                     : worker_solve(worker, values, &outcome, NULL);
    if (!ensemble_has_result(status))
        return (struct ensemble_extra){.restitution = NAN, .tangential = {NAN, NAN}, .error = NAN};
    return (struct ensemble_extra){.restitution = outcome.restitution,
                                   .tangential = {outcome.tangential[0], outcome.tangential[1]},
                                   .error = outcome.error};
}

uint64_t ensemble_next_check(const struct ensemble *ensemble, uint64_t done)
{
    bool stops = ensemble->spec.half_width > 0.0 || ensemble->spec.quantile_half_width > 0.0;
    uint64_t next = stops ? FIRST_CHECK : ensemble->count;
    while (next <= done && next < ensemble->count)
        next *= 2;
    return next < ensemble->count ? next : ensemble->count;
}
