/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What an input deck of Abaqus or CalculiX says beyond nodes and elements: sets of elements,
 * materials, sections, surfaces; and how parts and sets of nodes follow from them. */
#ifndef PERCUSS_MESH_DECK_H
#define PERCUSS_MESH_DECK_H

#include "mesh/builder.h"

struct deck_set {
    char name[MESH_NAME_SIZE];
    struct builder_list labels; /* of elements */
};

/* In units of N, s and the file's length. */
struct deck_material {
    char name[MESH_NAME_SIZE];
    bool elastic, dense;
    double young, poisson, density;
    size_t stress_count; /* of *PLASTIC: its first two rows */
    double stress[2], strain[2];
};

struct deck_section {
    size_t set, material;
};

/* An element that is no solid: a shell, a line; it names nodes only. */
struct deck_other {
    size_t label, first, count; /* nodes are others_nodes[first] .. */
};

/* Faces of elements (by label, or of a set of them) that belong to a surface. */
struct deck_faces {
    size_t surface; /* set of nodes */
    size_t label;   /* of an element, where set is SIZE_MAX */
    size_t set;
    int face; /* 1 to 6 */
};

/* Zeroed to begin with. Whatever adds returns false or SIZE_MAX when it is out of memory. */
struct deck {
    struct builder builder;
    size_t set_count, set_room;
    struct deck_set *sets;
    size_t material_count, material_room;
    struct deck_material *materials;
    size_t section_count, section_room;
    struct deck_section *sections;
    size_t other_count, other_room;
    struct deck_other *others;
    struct builder_list others_nodes;
    size_t face_count, face_room;
    struct deck_faces *faces;
};

/* Found whatever the case of their letters, made where they are not there. */
size_t deck_element_set(struct deck *deck, const char *name);
size_t deck_node_set(struct deck *deck, const char *name);
size_t deck_material(struct deck *deck, const char *name);

/* SIZE_MAX: there is none. */
size_t deck_find_element_set(const struct deck *deck, const char *name);
size_t deck_find_node_set(const struct deck *deck, const char *name);

bool deck_add_section(struct deck *deck, size_t set, size_t material);
bool deck_add_other(struct deck *deck, size_t label, const size_t *nodes, size_t count);
bool deck_add_faces(struct deck *deck, const struct deck_faces *faces);

/* The mesh with parts by section, materials in SI, and sets of nodes. PERCUSS_BAD_REQUEST: an
 * element in two sections, materials that are none in these units. */
enum percuss_status deck_finish(struct deck *deck, const char *file, double unit,
                                struct solid_mesh *mesh, struct fault *fault);

void deck_free(struct deck *deck);

#endif
