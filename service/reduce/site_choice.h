/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Places all over a surface, evenly far from each other. */
#ifndef PERCUSS_REDUCE_SITE_CHOICE_H
#define PERCUSS_REDUCE_SITE_CHOICE_H

#include "reduce/flexibility_place.h"

/* What is asked for. */
struct site_choice {
    double spacing; /* m: no place of a patch is farther than this from a chosen one, nor, near a
                     * sharp edge, twice as far from that or half ... */
    size_t most;    /* ... unless so many are chosen */
    size_t wanted_count;
    const struct flexibility_place *wanted; /* these in any case */
};

/* Chosen places, one array to be freed; `*spacing` becomes what was reached far from edges. NULL:
 * no memory. */
struct flexibility_place *site_choice_make(const struct site_choice *choice,
                                           const struct surface_rule *rule,
                                           const struct flexibility_edges *edges, size_t *count,
                                           double *spacing);

#endif
