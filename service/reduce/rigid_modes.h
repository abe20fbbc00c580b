/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The motions of a mesh as a whole that its supports allow. */
#ifndef PERCUSS_REDUCE_RIGID_MODES_H
#define PERCUSS_REDUCE_RIGID_MODES_H

#include "mesh/bulk.h"
#include "mesh/matrices.h"

enum { RIGID_MOST = 6 };

/* A square of a frequency (1/s^2) near that of the first elastic mode of a free body, from its
 * size, slenderness and stiffest material: good to a factor of ten or so. */
double rigid_modes_scale(const struct solid_mesh *mesh, const struct bulk *bulk);

/* M-orthonormal vectors that K does not resist, at most six, [count][3 node_count]; `scale` as
 * above tells what counts as no resistance. The vectors are the caller's to free. PERCUSS_INTERNAL
 * without memory. */
enum percuss_status rigid_modes_make(const struct solid_mesh *mesh, const struct matrices *matrices,
                                     double scale, size_t *count, double **vectors,
                                     struct fault *fault);

#endif
