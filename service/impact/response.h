/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What forces on a step do to an approach by way of a set of oscillators, kept for the places that
 * were asked of last: a search solves by the same modes several times, a rig and an ensemble hit
 * the same site thousands of times. The key are the participations, to the last bit, so that a hit
 * and a miss give the same bits. */
#ifndef PERCUSS_IMPACT_RESPONSE_H
#define PERCUSS_IMPACT_RESPONSE_H

#include <stdbool.h>
#include <stddef.h>

#include "impact/collocation.h"

/* Pairs of rows that are kept of a set, and levels of each: those of a phase lie together. */
enum { RESPONSE_PAIRS = 16, RESPONSE_LEVELS = 16 };

/* Of a pair of rows. */
struct response;

/* Of a set of oscillators. */
struct responses;

void responses_free(struct responses *kept); /* NULL is allowed */

/* That of two rows of `length` participations, or the same one twice; made in place of the one that
 * was not asked of for longest, as is *kept when first asked of. Valid until as many others as
 * are kept have been asked for. NULL: out of memory. */
struct response *responses_find(struct responses **kept, const double *const rows[2],
                                size_t length);

/* Its block of a level; where that is not *known yet, zeros for the caller to fill. */
double (*response_block(struct response *response, int level, bool *known))[NODES];

#endif
