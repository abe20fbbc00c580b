/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies from the files of meshers and finite-element programs; docs/mesh.md describes each
 * format. */
#ifndef PERCUSS_MESH_MESH_READ_H
#define PERCUSS_MESH_MESH_READ_H

#include "base/sha256.h"
#include "mesh/solid_mesh.h"

struct mesh_options {
    double unit;          /* m of one unit of length of the file */
    double size;          /* m: size of elements that Gmsh makes; 0: its default */
    const char *instance; /* of a deck's assembly; NULL: the only one with solids */
    bool raise; /* linear elements are taken, with mid nodes in the middle of their edges */
};

/* The metres of "m", "cm", "mm", "um", "in", "ft"; 0: another text. */
double mesh_read_unit(const char *name);

/* Reads Gmsh's .msh 4.1 (text or binary), decks of Abaqus and CalculiX (.inp) and Nastran (.bdf
 * .nas), VTK's legacy files (.vtk) and universal files (.unv), and runs Gmsh for other formats
 * (.step .stp .iges .igs .brep .stl .geo .mesh, .msh of other versions). The contents say which one
 * it is; the name where they leave it open. Converts the file's materials from units of N, s and
 * its length to SI. Drops nodes without elements. PERCUSS_BAD_REQUEST with "FILE:LINE: ..." unless
 * it is a body of 10-node tetrahedra, 15-node wedges and 20- or 27-node hexahedra. Free the mesh
 * with solid_mesh_free. */
enum percuss_status mesh_read(const char *path, const struct mesh_options *options,
                              struct solid_mesh *mesh, struct fault *fault);

/* Adds the bytes of a file, and of those that a deck includes: by INPUT= before *STEP, by INCLUDE
 * of Nastran. PERCUSS_BAD_REQUEST: one of them cannot be read. */
enum percuss_status mesh_digest(const char *path, struct sha256 *hash, struct fault *fault);

#endif
