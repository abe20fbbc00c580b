/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Gmsh as a process, which makes a mesh of a geometry or reads formats that we do not. */
#ifndef PERCUSS_MESH_GMSH_H
#define PERCUSS_MESH_GMSH_H

#include "base/fault.h"

enum { GMSH_PATH_SIZE = 256 };

/* A mesh in a folder of its own, both to be deleted with gmsh_forget. */
struct gmsh_file {
    char folder[GMSH_PATH_SIZE], mesh[GMSH_PATH_SIZE + 16], log[GMSH_PATH_SIZE + 16],
        script[GMSH_PATH_SIZE + 16];
};

enum gmsh_task {
    GMSH_CONVERT, /* the file holds a mesh */
    GMSH_MESH,    /* it holds a geometry: tetrahedra of second order */
    GMSH_FILL     /* it holds triangles of a surface: the same within them */
};

/* Runs gmsh on `path`. Geometries that know their unit come out in `unit` (m); elements are at most
 * `size` of these units (0: as Gmsh thinks best). PERCUSS_BAD_REQUEST: there is no gmsh, or it
 * fails, with its last words. */
enum percuss_status gmsh_run(const char *path, enum gmsh_task task, double unit, double size,
                             struct gmsh_file *file, struct fault *fault);

void gmsh_forget(const struct gmsh_file *file);

#endif
