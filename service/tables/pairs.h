/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which materials of a catalogue need contact tables. */
#ifndef PERCUSS_TABLES_PAIRS_H
#define PERCUSS_TABLES_PAIRS_H

#include <stdbool.h>
#include <stddef.h>

#include "model/body.h"

/* Two bodies that stand for all with their materials. */
struct table_pair {
    const struct body *a, *b;
};

/* Whether two bodies can meet in a contact of revolution (one has a sphere's surface, and all have
 * a flat or a round place), and whether one of them may yield. */
bool table_pair_is_round(const struct body *a, const struct body *b);
bool table_pair_yields(const struct body *a, const struct body *b);

/* All pairs of a catalogue that need a table, one for each pair of materials; *pairs is for free(),
 * NULL if there are none or (false) no memory. */
bool table_pairs_find(const struct body_set *set, struct table_pair **pairs, size_t *count);

#endif
