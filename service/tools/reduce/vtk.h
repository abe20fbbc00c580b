/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A mesh with its modes as ParaView shows them: VTK's XML of an unstructured grid (.vtu). */
#ifndef PERCUSS_REDUCE_VTK_H
#define PERCUSS_REDUCE_VTK_H

#include "mesh/solid_mesh.h"
#include "reduce/modes.h"

enum { VTK_MODES = 20 };

/* The first VTK_MODES modes, each an array of vectors named "mode 1: 92.27 Hz". A file that could
 * not be written whole is removed. PERCUSS_BAD_REQUEST with its name and the reason. */
enum percuss_status vtk_write(const char *path, const struct solid_mesh *mesh,
                              const struct modes *modes, struct fault *fault);

#endif
