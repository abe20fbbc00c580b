/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How many samples and extra solutions an ensemble takes, and what the extras belong to. */
#include "ensemble/ensemble.h"

enum {
    VERIFIED = 200,
    SUBSTITUTED = 1000, /* samples with one input drawn anew, at most, for each input */
    LEAST_SUBSTITUTED = 32,
    FIRST_CHECK = 256
};

static uint64_t verified(uint64_t done)
{
    return done < VERIFIED ? done : VERIFIED;
}

/* Samples to be repeated with an input drawn anew: all of that within half the work so far. Without
 * a second input there is nothing to tell apart, and correlated ones cannot change by themselves.
 */
static uint64_t substituted(const struct ensemble *ensemble, uint64_t done)
{
    size_t dimensions = ensemble->sampling.dimensions;
    if (dimensions < 2 || ensemble->copula.factor)
        return 0;
    uint64_t each = done / (2 * dimensions);
    each = each < SUBSTITUTED ? each : SUBSTITUTED;
    return each < LEAST_SUBSTITUTED ? 0 : each;
}

uint64_t ensemble_extras(const struct ensemble *ensemble, uint64_t done)
{
    return verified(done) + substituted(ensemble, done) * ensemble->sampling.dimensions;
}

struct ensemble_extra_place ensemble_extra_place(const struct ensemble *ensemble, uint64_t done,
                                                 uint64_t k)
{
    uint64_t checks = verified(done);
    if (k < checks)
        return (struct ensemble_extra_place){k * done / checks, SIZE_MAX};
    uint64_t each = substituted(ensemble, done);
    uint64_t place = (k - checks) % each;
    return (struct ensemble_extra_place){place * done / each, (size_t)((k - checks) / each)};
}

uint64_t ensemble_next_check(const struct ensemble *ensemble, uint64_t done)
{
    bool stops = ensemble->spec.half_width > 0.0 || ensemble->spec.quantile_half_width > 0.0;
    uint64_t next = stops ? FIRST_CHECK : ensemble->count;
    while (next <= done && next < ensemble->count)
        next *= 2;
    return next < ensemble->count ? next : ensemble->count;
}
