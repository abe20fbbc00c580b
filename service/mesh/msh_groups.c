/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/msh_groups.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/grow.h"

bool msh_groups_add(struct msh_groups *groups, const struct msh_group *group)
{
    if (!GROW(groups->groups, groups->group_count, groups->group_room))
        return false;
    groups->groups[groups->group_count++] = *group;
    return true;
}

bool msh_groups_join(struct msh_groups *groups, struct msh_member member)
{
    if (!GROW(groups->members, groups->member_count, groups->member_room))
        return false;
    groups->members[groups->member_count++] = member;
    return true;
}

size_t msh_groups_of(const struct msh_groups *groups, int dimension, int entity, int *tags,
                     size_t room)
{
    size_t count = 0;
    for (size_t i = 0; i < groups->member_count && count < room; i++)
        if (groups->members[i].dimension == dimension && groups->members[i].entity == entity)
            tags[count++] = groups->members[i].tag;
    return count;
}

void msh_groups_name(const struct msh_groups *groups, int dimension, int tag,
                     char name[MESH_NAME_SIZE])
{
    static const char *const KINDS[] = {"point", "curve", "surface", "volume"};
    snprintf(name, MESH_NAME_SIZE, "%s %d", KINDS[dimension], tag);
    for (size_t i = 0; i < groups->group_count; i++)
        if (groups->groups[i].dimension == dimension && groups->groups[i].tag == tag)
            memcpy(name, groups->groups[i].name, MESH_NAME_SIZE);
}

void msh_groups_free(struct msh_groups *groups)
{
    free(groups->groups);
    free(groups->members);
    memset(groups, 0, sizeof *groups);
}
