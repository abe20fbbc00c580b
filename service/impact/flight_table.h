/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The intervals of flights have lengths of the ladder of steps, but no force acts on them: the maps
 * of free motion are all that they take, a tenth of what a contact's step does. */
#ifndef PERCUSS_IMPACT_FLIGHT_TABLE_H
#define PERCUSS_IMPACT_FLIGHT_TABLE_H

#include "impact/step_table.h"

/* The map of a set's free motion over the step of a level (see flight_kernel_step), made when first
 * asked for; belongs to the set. NULL: out of memory. */
const double *flight_table(struct oscillators *set, int level);

#endif
