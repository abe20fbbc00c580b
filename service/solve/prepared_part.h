/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Groups of a body's modes, and parts of them: what a place excites of a group. */
#ifndef PERCUSS_SOLVE_PREPARED_PART_H
#define PERCUSS_SOLVE_PREPARED_PART_H

#include "impact/step_table.h"

/* Modes whose shapes are all even, all odd, or (longitudinal, unlike supports) anything. */
struct prepared_group {
    struct oscillators *set;
    size_t *mode; /* [set->count]: index within the family */
};

/* Parts of any groups; all zero: none. */
struct prepared_parts {
    struct prepared_part *first;
    size_t count;
};

/* The modes which[0 .. count - 1], ascending, of a group, made when first asked for. They stay
 * until they are cleared, which they must be before the group goes. NULL: out of memory. */
const struct prepared_group *prepared_parts_get(struct prepared_parts *parts,
                                                const struct prepared_group *whole,
                                                const size_t *which, size_t count);
void prepared_parts_clear(struct prepared_parts *parts);

#endif
