/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which material each part of a mesh is made of. */
#ifndef PERCUSS_REDUCE_MATERIALS_H
#define PERCUSS_REDUCE_MATERIALS_H

#include "mesh/solid_mesh.h"
#include "reduce/options.h"

/* What the command line says wins over what the mesh's file says. PERCUSS_BAD_REQUEST: a part has
 * no material, or there is no such part or material. */
enum percuss_status materials_assign(const struct options *options, struct solid_mesh *mesh,
                                     struct fault *fault);

#endif
