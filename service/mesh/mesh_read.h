/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies from the files of meshers and finite-element programs. docs/mesh.md says what is read of
 * each format. */
#ifndef PERCUSS_MESH_MESH_READ_H
#define PERCUSS_MESH_MESH_READ_H

#include "base/sha256.h"
#include "mesh/solid_mesh.h"

struct mesh_options {
    double unit; /* m of one unit of length of the file */
    double size; /* m: of the elements, where Gmsh is to make them; 0: as it thinks best */
};

/* The metres of "m", "cm", "mm", "um", "in", "ft"; 0: another text. */
double mesh_read_unit(const char *name);

/* Reads FILE.msh (Gmsh 4.1, text or binary) or FILE.inp (Abaqus, CalculiX) itself, and what Gmsh
 * reads (.step .stp .iges .igs .brep .stl .geo .bdf .nas .unv .vtk, .msh of other versions) by
 * running it. Materials that a file states are in units of N, s and its unit of length, and are SI
 * then. Nodes without elements are dropped. PERCUSS_BAD_REQUEST with "FILE:LINE: ..." for what is
 * not a body of 10-node tetrahedra and 20- or 27-node hexahedra. Free the mesh with
 * solid_mesh_free. */
enum percuss_status mesh_read(const char *path, const struct mesh_options *options,
                              struct solid_mesh *mesh, struct fault *fault);

/* Adds a file's bytes, and those of the files that a deck (.inp) takes in by *INCLUDE as far as it
 * is read. PERCUSS_BAD_REQUEST: one of them cannot be read. */
enum percuss_status mesh_digest(const char *path, struct sha256 *hash, struct fault *fault);

#endif
