/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A body as a mesh of elements of second order, as read from a file. */
#ifndef PERCUSS_MESH_SOLID_MESH_H
#define PERCUSS_MESH_SOLID_MESH_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "model/material.h"

/* Nodes of an element in the order of Gmsh. */
enum element_type { ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27, ELEMENT_WEDGE15, ELEMENT_TYPES };

enum { ELEMENT_MOST_NODES = 27, MESH_NAME_SIZE = 96, MESH_REMARK_SIZE = 240 };

/* Elements of one material: a physical volume, an element set. */
struct mesh_part {
    char name[MESH_NAME_SIZE];
    bool has_material;              /* the file states it; else the caller sets it */
    struct material material;       /* what the file does not state: NAN */
    char lacks[2 * MESH_NAME_SIZE]; /* which card is not there, "" where formats have none */
};

/* Named nodes that a support may hold: a physical surface, a node set. Names of decks have a scope
 * each, the part, assembly or instance where they stand. */
struct mesh_set {
    char name[MESH_NAME_SIZE];
    char scope[MESH_NAME_SIZE];    /* "": there is none */
    char instance[MESH_NAME_SIZE]; /* that the body is of the part `scope`; "": none */
    const char *kind;              /* "nodes", "elements", "surface"; NULL: there is one kind */
    size_t count;
    size_t *nodes; /* [count], ascending */
};

/* A rigid mass that moves with a node, without an inertia of its own. */
struct mesh_mass {
    size_t node;
    double mass; /* kg */
};

/* Owns its arrays. */
struct solid_mesh {
    double unit; /* m of one unit of length of the file */
    size_t node_count;
    double (*points)[3]; /* [node_count], m, in the file's frame */
    size_t *labels;      /* [node_count]: the file's numbers, for messages */
    size_t element_count;
    unsigned char *types; /* [element_count], enum element_type */
    size_t *first;        /* [element_count + 1]: an element's nodes are nodes[first[e]] .. */
    size_t *nodes;
    size_t *parts;          /* [element_count]: index of its part */
    size_t *element_labels; /* [element_count]: the file's numbers, for messages */
    size_t part_count;
    struct mesh_part *part;
    size_t set_count;
    struct mesh_set *set;
    size_t mass_count;
    struct mesh_mass *masses; /* [mass_count], nodes ascending */
    size_t remark_count;
    char (*remarks)[MESH_REMARK_SIZE]; /* what its reader left out or added, for the user */
};

/* The set of a name: SCOPE.NAME, INSTANCE.NAME or NAME, each with " (KIND)" behind it if wanted.
 * PERCUSS_BAD_REQUEST: there is none, or several that differ; the message lists them. */
enum percuss_status solid_mesh_find_set(const struct solid_mesh *mesh, const char *name,
                                        size_t *index, struct fault *fault);

void solid_mesh_free(struct solid_mesh *mesh);

#endif
