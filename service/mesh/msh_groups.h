/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The physical groups of a file of Gmsh, and which points, curves, surfaces and volumes are in
 * them. */
#ifndef PERCUSS_MESH_MSH_GROUPS_H
#define PERCUSS_MESH_MSH_GROUPS_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/solid_mesh.h"

struct msh_group {
    int dimension, tag;
    char name[MESH_NAME_SIZE];
};

/* An entity of the geometry in a physical group. */
struct msh_member {
    int dimension, entity, tag;
};

/* Zeroed to begin with; owns its arrays. */
struct msh_groups {
    size_t group_count, group_room, member_count, member_room;
    struct msh_group *groups;
    struct msh_member *members;
};

/* False: out of memory. */
bool msh_groups_add(struct msh_groups *groups, const struct msh_group *group);
bool msh_groups_join(struct msh_groups *groups, struct msh_member member);

/* The tags of the groups that an entity is in, at most `room`; their number. */
size_t msh_groups_of(const struct msh_groups *groups, int dimension, int entity, int *tags,
                     size_t room);

/* A group's name; "surface 7" where the file gives it none. */
void msh_groups_name(const struct msh_groups *groups, int dimension, int tag,
                     char name[MESH_NAME_SIZE]);

void msh_groups_free(struct msh_groups *groups);

#endif
