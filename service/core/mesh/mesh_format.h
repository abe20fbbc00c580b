/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which format a mesh's file has: by its first line, and where that leaves it open by its name. */
#ifndef PERCUSS_MESH_MESH_FORMAT_H
#define PERCUSS_MESH_MESH_FORMAT_H

#include "base/fault.h"

enum mesh_format {
    MESH_FORMAT_NONE, /* none that is read */
    MESH_FORMAT_MSH,
    MESH_FORMAT_INP,
    MESH_FORMAT_BDF,
    MESH_FORMAT_VTK,
    MESH_FORMAT_UNV,
    MESH_FORMAT_MESHED, /* Gmsh converts it */
    MESH_FORMAT_SHAPE,  /* Gmsh meshes it */
    MESH_FORMAT_SURFACE /* Gmsh fills it */
};

enum mesh_format mesh_format_of(const char *path);

/* PERCUSS_BAD_REQUEST: what to export from the program that the file is of, or the names of
 * formats.
 */
enum percuss_status mesh_format_refuse(const char *path, struct fault *fault);

#endif
