/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Gmsh's own format 4.1, as text or binary (Gmsh reference manual, MSH file format). */
#ifndef PERCUSS_MESH_MSH_H
#define PERCUSS_MESH_MSH_H

#include "mesh/solid_mesh.h"

/* Physical volumes are the parts, other volumes parts "volume N"; physical surfaces, curves and
 * points are sets of nodes, "surface N" where they have no name. `file` begins messages, in place
 * of `path`. */
enum percuss_status msh_read(const char *path, const char *file, double unit,
                             struct solid_mesh *mesh, struct fault *fault);

/* Whether a file is one of version 4.1; Gmsh converts other versions. */
bool msh_is_readable(const char *path);

#endif
