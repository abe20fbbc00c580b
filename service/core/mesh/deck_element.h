/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Elements as decks of Abaqus and CalculiX number their nodes. */
#ifndef PERCUSS_MESH_DECK_ELEMENT_H
#define PERCUSS_MESH_DECK_ELEMENT_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/solid_mesh.h"

/* Linear ones follow those of second order, in their order. Others are shells, lines and points:
 * they name nodes only. */
enum deck_element_kind {
    DECK_C3D10,
    DECK_C3D15,
    DECK_C3D20,
    DECK_C3D4,
    DECK_C3D6,
    DECK_C3D8,
    DECK_OTHER
};

/* Nodes of a solid; 0 of others. */
size_t deck_element_nodes(enum deck_element_kind kind);

/* The nodes of face S1 to S6 among an element's, as indices; how many: 0 where it has no such
 * face. */
size_t deck_element_face(enum deck_element_kind kind, int face, const unsigned char **nodes);

/* A solid as an element of ours, `made` in its order of nodes, with BUILDER_MIDDLE for those that a
 * linear one lacks. A brick that has nodes more than once becomes the wedge or the tetrahedron that
 * it is. NULL, or what is wrong with its nodes, of
 * which *node is one. */
const char *deck_element_make(enum deck_element_kind kind, const size_t *nodes,
                              enum element_type *type, size_t made[ELEMENT_MOST_NODES],
                              size_t *node);

#endif
