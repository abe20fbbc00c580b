/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Measured times and their quantiles. */
#ifndef PERCUSS_BENCH_SAMPLES_H
#define PERCUSS_BENCH_SAMPLES_H

#include <stddef.h>

struct samples {
    double *values;
    size_t count, room;
};

/* Empty, with room for `room` values; ends the program if there is no memory. */
struct samples samples_create(size_t room);
void samples_free(struct samples *samples);

/* Adds a value; it is dropped when the room is used up. */
void samples_add(struct samples *samples, double value);

/* The smallest value that at least the share `p` of all does not exceed; sorts them. NAN: none. */
double samples_quantile(struct samples *samples, double p);

/* Monotonic time, s. */
double samples_now(void);

#endif
