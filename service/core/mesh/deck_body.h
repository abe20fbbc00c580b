/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The one body of a deck as a mesh: the solids of the deck itself, or of one instance of a part
 * where the assembly puts it. */
#ifndef PERCUSS_MESH_DECK_BODY_H
#define PERCUSS_MESH_DECK_BODY_H

#include "mesh/deck.h"

/* The mesh with parts by section, materials in SI, masses on nodes, sets of nodes with their
 * scopes, and remarks. `instance`: which one of an assembly; NULL: the only one with solids.
 * PERCUSS_BAD_REQUEST: several bodies or none, an element in two sections, names that are not
 * there, materials outside the limits. */
enum percuss_status deck_body_make(struct deck *deck, double unit, const char *instance,
                                   struct solid_mesh *mesh, struct fault *fault);

#endif
