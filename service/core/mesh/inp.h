/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Input decks of Abaqus and CalculiX: nodes, solid elements of second order, sets, sections,
 * materials, surfaces, parts and their instances, up to the first *STEP. What else stands there is
 * refused by its line, told in the mesh's remarks, or known to say nothing of the body. */
#ifndef PERCUSS_MESH_INP_H
#define PERCUSS_MESH_INP_H

#include "mesh/solid_mesh.h"

enum { INP_MOST_DEPTH = 8, INP_PATH_SIZE = 1024 };

/* Element sets with a *SOLID SECTION are the parts, else the ELSETs of *ELEMENT; *NSET, *SURFACE
 * and sets of shells are sets of nodes. `instance`: which one of an assembly; NULL: the only one.
 * `raise`: linear elements are taken, too, as builder.h makes those of second order of them. */
enum percuss_status inp_read(const char *path, double unit, const char *instance, bool raise,
                             struct solid_mesh *mesh, struct fault *fault);

/* The path of a file that `file`, a deck or one that the deck includes, names in *INCLUDE: the
 * first one that is there of the deck's folder, the folder of `file` and the current one. */
void inp_include_path(const char *deck, const char *file, const char *name,
                      char path[INP_PATH_SIZE]);

#endif
