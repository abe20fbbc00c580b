/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* I-deas' universal files (.unv), as Salome, FreeCAD and Simcenter write them: nodes (datasets 15,
 * 781, 2411), elements (780, 2412), groups (2417 to 2477) (Structural Dynamics Research Laboratory,
 * University of Cincinnati: Universal file formats). */
#ifndef PERCUSS_MESH_UNV_H
#define PERCUSS_MESH_UNV_H

#include "mesh/solid_mesh.h"

/* A group's solids are a part of its name, its nodes and those of its faces and lines a set; solids
 * in no group are the part "property 1" by their physical property. `raise`: linear elements are
 * taken and raised. */
enum percuss_status unv_read(const char *path, double unit, bool raise, struct solid_mesh *mesh,
                             struct fault *fault);

#endif
