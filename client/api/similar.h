/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_API_SIMILAR_H
#define PERCUSS_API_SIMILAR_H

#include <percuss/server.h>

/* Letters to insert, delete, replace or swap with the next to get from one text to the other, each
 * of them once at most (optimal string alignment; Damerau, 1964); texts longer than an id are
 * compared up to its length. */
unsigned similar_distance(const char *one, const char *other);

/* The body whose id is nearest, if less than half of it is wrong; NULL: none. */
const struct percuss_body *similar_body(const struct percuss_body_list *list, const char *id);

#endif
