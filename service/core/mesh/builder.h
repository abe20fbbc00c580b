/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Collects nodes, elements, parts and sets by the file's own labels, and makes a solid_mesh of
 * them. */
#ifndef PERCUSS_MESH_BUILDER_H
#define PERCUSS_MESH_BUILDER_H

#include <stdint.h>

#include "mesh/solid_mesh.h"

/* A list that grows. */
struct builder_list {
    size_t count, room;
    size_t *values;
};

struct builder_node {
    size_t label;
    double point[3]; /* in units of the file */
};

struct builder_element {
    size_t label, first, part;
    unsigned char type;
};

struct builder_set {
    char name[MESH_NAME_SIZE], scope[MESH_NAME_SIZE], instance[MESH_NAME_SIZE];
    const char *kind;           /* as in struct mesh_set */
    struct builder_list labels; /* of nodes */
};

struct builder_mass {
    size_t label; /* of its node */
    double mass;  /* N s^2 per unit of length of the file */
};

/* In place of the label of a mid node: the middle of its edge. */
#define BUILDER_MIDDLE SIZE_MAX

/* Zero it before use. Functions that add return false when out of memory. */
struct builder {
    bool raise; /* elements may have BUILDER_MIDDLE: the caller wants linear ones raised */
    bool wedges_either_way; /* the format's wedges may run either way round: none is told of */
    size_t node_count, node_room;
    struct builder_node *nodes;
    size_t element_count, element_room;
    struct builder_element *elements;
    struct builder_list connectivity; /* labels of nodes, element by element, in Gmsh's order */
    size_t part_count, part_room;
    struct mesh_part *parts;
    size_t set_count, set_room;
    struct builder_set *sets;
    size_t mass_count, mass_room;
    struct builder_mass *masses;
    size_t remark_count, remark_room;
    char (*remarks)[MESH_REMARK_SIZE];
};

bool builder_append(struct builder_list *list, size_t value);

bool builder_add_node(struct builder *builder, size_t label, const double point[3]);

/* `nodes`: labels, element_node_count(type) of them. Mid nodes may be BUILDER_MIDDLE, which
 * builder_finish makes: the elements along an edge share one, that of an element that has its own
 * goes before, and a set that has both ends has it. */
bool builder_add_element(struct builder *builder, enum element_type type, size_t label, size_t part,
                         const size_t *nodes);

/* A mass > 0 on a node. builder_finish adds those of one node up, and tells of those taken and of
 * those whose node no element has, which are left out. */
bool builder_add_mass(struct builder *builder, size_t label, double mass);

/* The index of the part or set of a name, made if there is none; SIZE_MAX: out of memory. Long
 * names are cut. */
size_t builder_part(struct builder *builder, const char *name);
size_t builder_set(struct builder *builder, const char *name);

/* Tells the user what the body lacks or has besides; cut to fit. */
bool builder_remark(struct builder *builder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* A further set, whatever the names of others. */
size_t builder_add_set(struct builder *builder, const char *name);

/* Makes the mesh, lengths times `unit`; drops parts, sets and nodes that no element uses; takes a
 * node that is there again in the same place once. `file` begins messages. PERCUSS_BAD_REQUEST: no
 * elements, duplicate or missing labels, coordinates that are not finite. */
enum percuss_status builder_finish(struct builder *builder, const char *file, double unit,
                                   struct solid_mesh *mesh, struct fault *fault);

void builder_free(struct builder *builder);

#endif
