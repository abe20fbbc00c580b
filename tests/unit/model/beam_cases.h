/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Beams and helpers that several tests of beams share. */
#ifndef PERCUSS_TEST_BEAM_CASES_H
#define PERCUSS_TEST_BEAM_CASES_H

#include "check.h"
#include "model/beam.h"

/* Length, EI and rho A are one, so that omega is b. */
__attribute__((unused)) static const struct beam_plane slim = {1.0, 1.0, INFINITY,
                                                               1.0, 0.0, {0}}; /* Euler-Bernoulli */
__attribute__((unused)) static const struct beam_plane slender = {1.0, 1.0,           21845.0,
                                                                  1.0, 1.0 / 65536.0, {0}};
__attribute__((unused)) static const struct beam_plane stubby = {1.0, 1.0,        21.0,
                                                                 1.0, 1.0 / 64.0, {0}};
__attribute__((unused)) static const struct beam_plane block = {1.0, 1.0,        5.25,
                                                                1.0, 1.0 / 16.0, {0}};

static inline struct beam_plane supported(const struct beam_plane *plane, enum support left,
                                          enum support right)
{
    struct beam_plane copy = *plane;

    copy.supports[0] = left;
    copy.supports[1] = right;
    return copy;
}

static inline struct beam_mode *solve(const struct beam_plane *plane, size_t count)
{
    struct beam_mode *modes = malloc(count * sizeof *modes);

    assert_non_null(modes);
    beam_modes(plane, count, modes);
    return modes;
}

#endif
