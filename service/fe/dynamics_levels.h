/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which element steps how fast, and the order of the nodes that follows. */
#ifndef PERCUSS_FE_DYNAMICS_LEVELS_H
#define PERCUSS_FE_DYNAMICS_LEVELS_H

#include "fe/dynamics.h"

/* Sets element_level, levels and step from the longest step of each element; `node_level` (by
 * node, quads in the same numbering) becomes the finest level around it; `scratch` holds one byte
 * an element. Between a level and the next but one lie bands of elements that waves too fast for
 * the coarser one cannot cross. */
void dynamics_levels_assign(struct dynamics *dynamics, const double *longest, uint8_t *node_level,
                            uint8_t *scratch);

/* Renumbers nodes by level, those of the axis first; `order` holds `nodes` numbers. */
void dynamics_levels_sort(struct dynamics *dynamics, const uint8_t *node_level, uint32_t *order);

#endif
