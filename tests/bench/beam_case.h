/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The paper's steel sphere on the middle of its aluminium beam: what its benchmarks have in common.
 */
#ifndef PERCUSS_BENCH_BEAM_CASE_H
#define PERCUSS_BENCH_BEAM_CASE_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "model/beam.h"
#include "spatial/collision.h"

enum { BEAM_CASE_SPEEDS = 16 };

/* The handbook's materials, PHYSICS.md; m. */
static const struct material BEAM_CASE_BEAM = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0};
static const struct material BEAM_CASE_SPHERE = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
static const double BEAM_CASE_RADIUS = 0.01, BEAM_CASE_LENGTH = 1.0, BEAM_CASE_BALL = 0.015;

/* What every one of them is asked. */
struct beam_case {
    double speeds[BEAM_CASE_SPEEDS], fastest; /* m/s */
    size_t speed_count;
    const char *history; /* of the first speed; NULL: none */
    bool headless;
};

/* An option of a benchmark's own, for a number or a count. */
struct beam_case_option {
    const char *name;
    double *number; /* NULL: a count */
    size_t *count;
};

/* Reads --speed (again for more; default 0.2), --history, --no-header and own options, which end
 * with one without a name. False: it has said what is wrong. */
bool beam_case_read(int count, char **words, const struct beam_case_option *own,
                    struct beam_case *asked);

/* The beam's bending by Timoshenko's theory with Hutchinson's factor: 3-D to 1e-3. */
struct beam_plane beam_case_plane(void);

/* Processor time so far, s. */
double beam_case_seconds(void);

/* A file for histories, begun; NULL: it cannot be written. */
FILE *beam_case_history(const char *name);

/* Of the first speed: time, where the bodies are along the blow, the sphere's velocity, force. For
 * collision_settings, `context` being the file. */
void beam_case_record(void *context, size_t which, const struct collision *now);

/* The last column, and the end of the line. */
void beam_case_print_sub_impacts(const struct collision *found);

#endif
