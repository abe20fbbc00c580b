/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_FUZZ_MESH_PARTS_H
#define PERCUSS_FUZZ_MESH_PARTS_H

#include "mesh/solid_mesh.h"

/* All that is made of a mesh that was read: its surface, what is said of it and its matrices; the
 * mesh keeps its own rules. */
void fuzz_mesh(const struct solid_mesh *mesh);

#endif
