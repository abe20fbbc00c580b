/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples y(x) sorted by x, and classes of neighbours among them. */
#ifndef PERCUSS_ENSEMBLE_CLASSES_H
#define PERCUSS_ENSEMBLE_CLASSES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A sample. */
struct member {
    double x, y;    /* y less the mean of all */
    size_t sample;  /* its place in the order of the points */
    uint32_t order; /* of equal x: at random, since neighbours of a Sobol sequence are alike */
};

/* Neighbours in x: members [first, end). */
struct class
{
    size_t first, end;
    double sum; /* of y */
};

/* What one replicate has in a class. */
struct class_part {
    double sum, count;
};

struct classes {
    size_t replicates; /* sample i belongs to i mod this; 1: each is independent of all others */
    size_t member_count;
    struct member *members; /* by ascending x */
    size_t *place;          /* of each sample among them; SIZE_MAX: a value is missing */
    double mean, variance;  /* of y */
    size_t count;
    struct class *list;
    struct class_part *parts; /* [count * replicates]; NULL: not asked for, or of no use */
};

/* Samples in the order of their points. */
struct class_samples {
    const double *x, *y; /* [count]; NAN: a value is missing */
    size_t count, replicates;
};

/* Of those that have both values; no classes yet. False: out of memory. Release it all the same. */
bool classes_create(struct classes *classes, const struct class_samples *samples);
void classes_release(struct classes *classes);

/* Makes classes of `size` members each, of less than twice as many where the members do not divide
 * evenly. Where many have the same x, a class does not reach from one value to the next. */
void classes_divide(struct classes *classes, size_t size);

static inline double class_size(const struct class *class)
{
    return (double)(class->end - class->first);
}

/* Afterwards class_mean_without may be called. False: out of memory. */
bool classes_split(struct classes *classes);

/* Mean of y in a class of what is independent of a member (an index; of this or another class):
 * without it, or where there are replicates without all of its own. 0, which is the mean of all,
 * where nothing else is left. */
double class_mean_without(const struct classes *classes, const struct class *class, size_t member);

/* The class of a value, or the nearest one. */
const struct class *class_at(const struct classes *classes, double x);

/* Variance of y within a class, from pairs of members of different replicates, as points of the
 * same one are not independent of each other. */
double class_variance(const struct classes *classes, const struct class *class);

#endif
