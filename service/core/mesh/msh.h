/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Gmsh's own format 4.1, as text or binary (Gmsh reference manual, MSH file format). */
#ifndef PERCUSS_MESH_MSH_H
#define PERCUSS_MESH_MSH_H

#include "mesh/solid_mesh.h"

struct msh_source {
    const char *path; /* of the mesh */
    const char *file; /* the user's, for messages */
    bool made;        /* Gmsh made the mesh of that file: its lines are not the user's */
};

/* Physical volumes are the parts, other volumes parts "volume N", with a note; physical surfaces,
 * curves and points are sets of nodes, "surface N" where they have no name. Files of all partitions
 * are taken. `raise`: linear elements are taken and raised. */
enum percuss_status msh_read(const struct msh_source *source, double unit, bool raise,
                             struct solid_mesh *mesh, struct fault *fault);

/* Whether a file is one of version 4.1, or none of Gmsh's; Gmsh converts other versions. */
bool msh_is_readable(const char *path);

#endif
