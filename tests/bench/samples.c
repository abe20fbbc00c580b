/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "samples.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

struct samples samples_create(size_t room)
{
    struct samples samples = {.values = malloc(room * sizeof(double)), .room = room};
    if (!samples.values) {
        fprintf(stderr, "out of memory\n");
        exit(EXIT_FAILURE);
    }
    return samples;
}

void samples_free(struct samples *samples)
{
    free(samples->values);
    *samples = (struct samples){0};
}

void samples_add(struct samples *samples, double value)
{
    if (samples->count < samples->room)
        samples->values[samples->count++] = value;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double samples_quantile(struct samples *samples, double p)
{
    if (samples->count == 0)
        return NAN;
    qsort(samples->values, samples->count, sizeof *samples->values, ascending);
    size_t rank = (size_t)ceil(p * (double)samples->count);
    return samples->values[rank > 0 ? rank - 1 : 0];
}

double samples_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
