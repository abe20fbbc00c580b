/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bulk data of Nastran: GRID in any coordinate system, CTETRA, CHEXA, PSOLID, MAT1 and what names
 * nodes (MSC Nastran Quick Reference Guide). */
#ifndef PERCUSS_MESH_BDF_H
#define PERCUSS_MESH_BDF_H

#include "mesh/bdf_card.h"
#include "mesh/solid_mesh.h"

/* Deeper INCLUDEs are refused. */
enum { BDF_MOST_DEPTH = 8 };

/* Each PSOLID is a part "PSOLID 1" with the material of its MAT1; sets are "SPC 3" (nodes held in
 * all directions), "RBE2 7" (its dependent nodes) and "PSHELL 2" (nodes of shells). `raise`: linear
 * elements are taken and raised. Notes name the other cards. */
enum percuss_status bdf_read(const char *path, double unit, bool raise, struct solid_mesh *mesh,
                             struct fault *fault);

#endif
