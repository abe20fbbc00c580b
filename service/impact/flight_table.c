/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/flight_table.h"

#include <stdlib.h>

#include "impact/flight_kernel.h"

const double *flight_table(struct oscillators *set, int level)
{
    if (!set->turns[level]) {
        struct flight_modes modes = {.length = set->stride,
                                     .damping = set->most_damping > 0.0 ? set->damping : NULL,
                                     .omega = set->omega};
        double *table = aligned_alloc(32, (set->stride + LANES) * TURN_TERMS * sizeof *table);
        if (!table)
            return NULL;
        flight_kernel_table(&modes, step_length(level), table);
        set->turns[level] = table;
    }
    return set->turns[level];
}
