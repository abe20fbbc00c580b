/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* VTK's legacy files of unstructured grids, text or binary, versions 1 to 5.1 (VTK File Formats;
 * the order of nodes is that of vtkQuadraticTetra, vtkQuadraticHexahedron,
 * vtkTriQuadraticHexahedron). */
#ifndef PERCUSS_MESH_VTK_LEGACY_H
#define PERCUSS_MESH_VTK_LEGACY_H

#include "mesh/solid_mesh.h"

/* Nodes and elements have VTK's numbers, from 0. A whole number for each cell ("CellEntityIds",
 * "gmsh:physical": the first one of CELL_DATA) names the parts, and the nodes of faces and lines:
 * "CellEntityIds 3"; without one all solids are the part "body". `raise`: linear cells are taken
 * and raised. */
enum percuss_status vtk_legacy_read(const char *path, double unit, bool raise,
                                    struct solid_mesh *mesh, struct fault *fault);

#endif
