/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stiffness and mass of one brick of 27 nodes (mesh/element.h); its map may be mirrored. */
#ifndef PERCUSS_SPATIAL_BRICK_H
#define PERCUSS_SPATIAL_BRICK_H

#include "mesh/element.h"

enum { BRICK_NODES = 27, BRICK_FREEDOMS = 81 };

/* Stiffness (N/m) of freedom 3 node + direction, mass (kg) of one direction. False: the map folds.
 */
bool brick_matrices(double points[ELEMENT_MOST_NODES][3], const struct material *material,
                    double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                    double mass[BRICK_NODES][BRICK_NODES]);

#endif
