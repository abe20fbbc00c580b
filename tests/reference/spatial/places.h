/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbered points of space, found by their coordinates. */
#ifndef PERCUSS_SPATIAL_PLACES_H
#define PERCUSS_SPATIAL_PLACES_H

#include <stddef.h>

/* Made by {.same = ...}; owns its arrays. */
struct places {
    double same; /* m: points nearer than this in each direction are one */
    size_t count, room, buckets;
    double (*points)[3]; /* [count] */
    size_t *next, *bucket;
};

void places_free(struct places *places);

/* Number of the point here; SIZE_MAX: none. */
size_t places_find(const struct places *places, const double point[3]);
/* The same, a new number where there is none; SIZE_MAX: no memory. */
size_t places_add(struct places *places, const double point[3]);

#endif
