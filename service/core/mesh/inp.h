/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Input decks of Abaqus and CalculiX: nodes, solid elements of second order, sets, sections,
 * materials, surfaces, up to the first *STEP. */
#ifndef PERCUSS_MESH_INP_H
#define PERCUSS_MESH_INP_H

#include "mesh/solid_mesh.h"

enum { INP_MOST_DEPTH = 8, INP_PATH_SIZE = 1024 };

/* Element sets with a *SOLID SECTION are the parts, else the ELSETs of *ELEMENT; *NSET, *SURFACE
 * and sets of shells are sets of nodes. */
enum percuss_status inp_read(const char *path, double unit, struct solid_mesh *mesh,
                             struct fault *fault);

/* The path of a file that `file` names in *INCLUDE. */
void inp_include_path(const char *file, const char *name, char path[INP_PATH_SIZE]);

#endif
