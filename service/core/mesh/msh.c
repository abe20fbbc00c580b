/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/msh.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/builder.h"
#include "mesh/element.h"
#include "mesh/grow.h"
#include "mesh/scan.h"

/* ---- physical groups, and the points, curves, surfaces and volumes in them ---- */

struct msh_group {
    int dimension, tag;
    char name[MESH_NAME_SIZE];
};

/* An entity of the geometry in a physical group. */
struct msh_member {
    int dimension, entity, tag;
};

/* A volume of one partition, and the volume of the geometry that it is a part of. */
struct msh_share {
    int entity, parent;
};

/* Zeroed to begin with; owns its arrays. */
struct msh_groups {
    size_t group_count, group_room, member_count, member_room, share_count, share_room;
    struct msh_group *groups;
    struct msh_member *members;
    struct msh_share *shares;
};

/* False: out of memory. */
static bool msh_groups_add(struct msh_groups *groups, const struct msh_group *group)
{
    if (!GROW(groups->groups, groups->group_count, groups->group_room))
        return false;
    groups->groups[groups->group_count++] = *group;
    return true;
}

static bool msh_groups_join(struct msh_groups *groups, struct msh_member member)
{
    if (!GROW(groups->members, groups->member_count, groups->member_room))
        return false;
    groups->members[groups->member_count++] = member;
    return true;
}

/* The tags of the groups of an entity, at most `room`; returns their number. */
static size_t msh_groups_of(const struct msh_groups *groups, int dimension, int entity, int *tags,
                            size_t room)
{
    size_t count = 0;
    for (size_t i = 0; i < groups->member_count && count < room; i++)
        if (groups->members[i].dimension == dimension && groups->members[i].entity == entity)
            tags[count++] = groups->members[i].tag;
    return count;
}

/* A group's name; "surface 7" where the file gives it none. */
static void msh_groups_name(const struct msh_groups *groups, int dimension, int tag,
                            char name[MESH_NAME_SIZE])
{
    static const char *const KINDS[] = {"point", "curve", "surface", "volume"};
    snprintf(name, MESH_NAME_SIZE, "%s %d", KINDS[dimension], tag);
    for (size_t i = 0; i < groups->group_count; i++)
        if (groups->groups[i].dimension == dimension && groups->groups[i].tag == tag)
            memcpy(name, groups->groups[i].name, MESH_NAME_SIZE);
}

static void msh_groups_free(struct msh_groups *groups)
{
    free(groups->groups);
    free(groups->members);
    free(groups->shares);
    memset(groups, 0, sizeof *groups);
}

/* ---- the file ---- */

enum { LINE_SIZE = 256, MOST_ENTITY_TAGS = 64 };

/* Gmsh's numbers of types of elements; 0 nodes: unknown */
enum {
    MSH_TET4 = 4,
    MSH_HEX8 = 5,
    MSH_WEDGE6 = 6,
    MSH_TET10 = 11,
    MSH_HEX27 = 12,
    MSH_HEX20 = 17,
    MSH_WEDGE15 = 18
};
static const struct {
    unsigned char nodes, dimension;
    const char *name;
} TYPES[] = {{0, 0, NULL},
             {2, 1, "2-node line"},
             {3, 2, "3-node triangle"},
             {4, 2, "4-node quadrangle"},
             {4, 3, "4-node tetrahedron"},
             {8, 3, "8-node hexahedron"},
             {6, 3, "6-node prism"},
             {5, 3, "5-node pyramid"},
             {3, 1, "3-node line"},
             {6, 2, "6-node triangle"},
             {9, 2, "9-node quadrangle"},
             {10, 3, "10-node tetrahedron"},
             {27, 3, "27-node hexahedron"},
             {18, 3, "18-node prism"},
             {14, 3, "14-node pyramid"},
             {1, 0, "point"},
             {8, 2, "8-node quadrangle"},
             {20, 3, "20-node hexahedron"},
             {15, 3, "15-node prism"},
             {13, 3, "13-node pyramid"}};

/* state of reading */
struct msh {
    struct scan scan;
    struct builder builder;
    struct msh_groups groups;
    const char *file;                 /* the user's */
    bool made;                        /* Gmsh has made the mesh of it */
    size_t flat;                      /* number of faces, lines and points */
    bool grouped;                     /* a volume is in a physical group */
    char alone[MESH_REMARK_SIZE / 2]; /* volumes that are in none */
};

static enum percuss_status msh_out_of_memory(const struct msh *msh)
{
    return fault_set(msh->scan.fault, PERCUSS_INTERNAL, "%s: out of memory", msh->scan.file);
}

static bool msh_read_format(struct scan *scan)
{
    double version = 0.0;
    int binary = 0, one = 0;
    size_t bytes = 0;
    scan->binary = false;
    if (!scan_real(scan, "version", &version) || !scan_integer(scan, "file-type", &binary) ||
        !scan_size(scan, "data-size", &bytes))
        return false;
    if (version < 4.1 || version >= 4.2) {
        scan_refuse(scan,
                    "version: %g: must be 4.1 (gmsh FILE -save -format msh41 -o NEW.msh writes it)",
                    version);
        return false;
    }
    if (bytes != sizeof(size_t)) {
        scan_refuse(scan, "data-size: %zu: must be %zu", bytes, sizeof(size_t));
        return false;
    }
    /* the rest of the line, then 1 in the order of bytes of the writer */
    char line[LINE_SIZE];
    scan_line(scan, line, sizeof line);
    if (binary != 1)
        return true;
    scan->binary = true;
    if (!scan_integer(scan, "order of bytes", &one))
        return false;
    if (one != 1)
        scan_refuse(scan, "order of bytes: %#x: must be this machine's", (unsigned)one);
    return one == 1;
}

/* lines: dimension tag "name"; text in binary files too */
static enum percuss_status read_names(struct msh *msh)
{
    struct scan *scan = &msh->scan;
    bool binary = scan->binary;
    size_t count;
    char line[LINE_SIZE];
    scan->binary = false;
    if (!scan_count(scan, "physical names", &count))
        return PERCUSS_BAD_REQUEST;
    scan_line(scan, line, sizeof line);
    for (size_t i = 0; i < count && scan_line(scan, line, sizeof line); i++) {
        struct msh_group group = {0};
        /* the length of a name is MESH_NAME_SIZE - 1 */
        if (sscanf(line, "%d %d \"%95[^\"]", &group.dimension, &group.tag, group.name) != 3)
            return scan_refuse(scan, "physical name: must be: dimension tag \"name\"");
        if (!msh_groups_add(&msh->groups, &group))
            return msh_out_of_memory(msh);
    }
    scan->binary = binary;
    return PERCUSS_OK;
}

/* the box of an entity, its physical groups, which are kept if `dimension` is theirs, its boundary
 */
static enum percuss_status read_membership(struct msh *msh, int dimension, int entity, bool keep)
{
    struct scan *scan = &msh->scan;
    double box;
    size_t count;
    int tag;
    for (int i = 0; i < (dimension == 0 ? 3 : 6); i++)
        if (!scan_real(scan, "entity's box", &box))
            return PERCUSS_BAD_REQUEST;
    /* the groups it belongs to, negative where it is turned over in them */
    if (!scan_count(scan, "entity's physical groups", &count))
        return PERCUSS_BAD_REQUEST;
    if (count > MOST_ENTITY_TAGS)
        return scan_refuse(scan, "physical groups of an entity: %zu: must be at most %d", count,
                           MOST_ENTITY_TAGS);
    for (size_t i = 0; i < count; i++) {
        if (!scan_integer(scan, "physical group", &tag))
            return PERCUSS_BAD_REQUEST;
        if (tag == INT_MIN)
            return scan_refuse(scan, "physical group: %d: must be a number of 31 bits", tag);
        if (keep &&
            !msh_groups_join(&msh->groups, (struct msh_member){dimension, entity, abs(tag)}))
            return msh_out_of_memory(msh);
    }
    /* its boundary is not used; a point has none */
    if (dimension == 0)
        return PERCUSS_OK;
    if (!scan_count(scan, "entity's boundary", &count))
        return PERCUSS_BAD_REQUEST;
    for (size_t i = 0; i < count; i++)
        if (!scan_integer(scan, "entity's boundary", &tag))
            return PERCUSS_BAD_REQUEST;
    return PERCUSS_OK;
}

/* one point, curve, surface or volume */
static enum percuss_status read_entity(struct msh *msh, int dimension)
{
    int entity;
    return scan_integer(&msh->scan, "entity", &entity)
               ? read_membership(msh, dimension, entity, true)
               : PERCUSS_BAD_REQUEST;
}

/* one of a partition: what it is a part of, and its partitions. Of two partitions' common surface
 * the groups are those of the volume, which are no surface's. `present` marks partitions that have
 * a volume */
static enum percuss_status read_partitioned(struct msh *msh, int dimension, bool *present,
                                            size_t partitions)
{
    struct scan *scan = &msh->scan;
    int entity, parent_dimension, parent, partition;
    size_t count;
    if (!scan_integer(scan, "entity", &entity) ||
        !scan_integer(scan, "parent's dimension", &parent_dimension) ||
        !scan_integer(scan, "parent", &parent) || !scan_count(scan, "partitions", &count))
        return PERCUSS_BAD_REQUEST;
    for (size_t i = 0; i < count; i++) {
        if (!scan_integer(scan, "partition", &partition))
            return PERCUSS_BAD_REQUEST;
        if (dimension == 3 && partition > 0 && (size_t)partition <= partitions)
            present[partition - 1] = true;
    }
    struct msh_groups *groups = &msh->groups;
    if (dimension == 3) {
        if (!GROW(groups->shares, groups->share_count, groups->share_room))
            return msh_out_of_memory(msh);
        groups->shares[groups->share_count++] = (struct msh_share){entity, parent};
    }
    return read_membership(msh, dimension, entity, parent_dimension == dimension);
}

/* all partitions must have their volumes in the file */
static enum percuss_status check_partitions(const struct msh *msh, const bool *present,
                                            size_t partitions, size_t volumes)
{
    size_t count = 0;
    for (size_t i = 0; i < partitions; i++)
        count += present[i];
    return count == partitions || volumes == 0
               ? PERCUSS_OK
               : scan_refuse(
                     &msh->scan,
                     "holds %zu of %zu partitions: must be whole (gmsh without -part_split)", count,
                     partitions);
}

static enum percuss_status read_partitions(struct msh *msh)
{
    struct scan *scan = &msh->scan;
    size_t partitions, ghosts, counts[4];
    int number;
    if (!scan_count(scan, "partitions", &partitions) || !scan_count(scan, "ghosts", &ghosts))
        return PERCUSS_BAD_REQUEST;
    for (size_t i = 0; i < 2 * ghosts; i++)
        if (!scan_integer(scan, "ghost", &number))
            return PERCUSS_BAD_REQUEST;
    for (int i = 0; i < 4; i++)
        if (!scan_count(scan, "number of entities", &counts[i]))
            return PERCUSS_BAD_REQUEST;
    bool *present = calloc(partitions + 1, sizeof *present);
    enum percuss_status status = present ? PERCUSS_OK : msh_out_of_memory(msh);
    for (int dimension = 0; dimension < 4; dimension++)
        for (size_t i = 0; i < counts[dimension] && status == PERCUSS_OK; i++)
            status = read_partitioned(msh, dimension, present, partitions);
    if (status == PERCUSS_OK)
        status = check_partitions(msh, present, partitions, counts[3]);
    free(present);
    return status;
}

static enum percuss_status read_entities(struct msh *msh)
{
    size_t counts[4];
    for (int i = 0; i < 4; i++)
        if (!scan_count(&msh->scan, "number of entities", &counts[i]))
            return PERCUSS_BAD_REQUEST;
    for (int dimension = 0; dimension < 4; dimension++)
        for (size_t i = 0; i < counts[dimension]; i++) {
            enum percuss_status status = read_entity(msh, dimension);
            if (status != PERCUSS_OK)
                return status;
        }
    return PERCUSS_OK;
}

/* the numbers of a block of nodes, then their points */
static enum percuss_status read_node_block(struct msh *msh)
{
    struct scan *scan = &msh->scan;
    struct builder *builder = &msh->builder;
    int dimension, entity, parametric;
    size_t count, label, first = builder->node_count;
    /* its entity and their number */
    if (!scan_integer(scan, "dimension", &dimension) || !scan_integer(scan, "entity", &entity) ||
        !scan_integer(scan, "parametric", &parametric) ||
        !scan_count(scan, "nodes of a block", &count))
        return PERCUSS_BAD_REQUEST;
    if (dimension < 0 || dimension > 3)
        return scan_refuse(scan, "dimension: %d: must be 0 to 3", dimension);
    /* first all labels */
    for (size_t i = 0; i < count; i++) {
        if (!scan_size(scan, "number of a node", &label))
            return PERCUSS_BAD_REQUEST;
        if (!builder_add_node(builder, label, (double[3]){0.0, 0.0, 0.0}))
            return msh_out_of_memory(msh);
    }
    /* then all points; parameters on a curve or surface are not used */
    for (size_t i = 0; i < count; i++) {
        double parameter, *point = builder->nodes[first + i].point;
        for (int k = 0; k < 3; k++)
            if (!scan_real(scan, "coordinate of a node", &point[k]))
                return PERCUSS_BAD_REQUEST;
        for (int k = 0; parametric && k < dimension; k++)
            if (!scan_real(scan, "parameter of a node", &parameter))
                return PERCUSS_BAD_REQUEST;
    }
    return PERCUSS_OK;
}

/* the first physical group of a volume, else the volume of the geometry */
static size_t find_part(struct msh *msh, int entity)
{
    char name[MESH_NAME_SIZE];
    int tag;
    if (msh_groups_of(&msh->groups, 3, entity, &tag, 1) == 1) {
        msh_groups_name(&msh->groups, 3, tag, name);
        msh->grouped = true;
        return builder_part(&msh->builder, name);
    }
    for (size_t i = 0; i < msh->groups.share_count; i++)
        if (msh->groups.shares[i].entity == entity) {
            entity = msh->groups.shares[i].parent;
            break;
        }
    snprintf(name, sizeof name, "volume %d", entity);
    size_t parts = msh->builder.part_count, part = builder_part(&msh->builder, name);
    if (part == parts && part != SIZE_MAX) {
        size_t length = strlen(msh->alone);
        snprintf(msh->alone + length, sizeof msh->alone - length, "%s%s", length ? ", " : "", name);
    }
    return part;
}

/* adds the nodes of an element to the sets of its entity */
static bool add_to_sets(struct msh *msh, const size_t *sets, size_t set_count, const size_t *nodes,
                        size_t count)
{
    for (size_t s = 0; s < set_count; s++)
        for (size_t i = 0; i < count; i++)
            if (!builder_append(&msh->builder.sets[sets[s]].labels, nodes[i]))
                return false;
    return true;
}

/* the sets of a point, curve or surface */
static enum percuss_status find_sets(struct msh *msh, int dimension, int entity, size_t *sets,
                                     size_t *count)
{
    char name[MESH_NAME_SIZE];
    int tags[MOST_ENTITY_TAGS];
    *count = msh_groups_of(&msh->groups, dimension, entity, tags, MOST_ENTITY_TAGS);
    for (size_t i = 0; i < *count; i++) {
        msh_groups_name(&msh->groups, dimension, tags[i], name);
        sets[i] = builder_set(&msh->builder, name);
        if (sets[i] == SIZE_MAX)
            return msh_out_of_memory(msh);
    }
    return PERCUSS_OK;
}

/* refuses a block of elements by its first one; in a file that Gmsh made, no line is the user's */
static enum percuss_status refuse_type(const struct msh *msh, const char *name, const char *allowed)
{
    struct fault ignored;
    struct scan ahead = msh->scan;
    size_t label = 0;
    ahead.fault = &ignored;
    scan_size(&ahead, "", &label);
    if (msh->made)
        return fault_set(msh->scan.fault, PERCUSS_BAD_REQUEST, "%s: element %zu: %s: must be %s",
                         msh->file, label, name, allowed);
    return scan_refuse(&msh->scan, "element %zu: %s: must be %s", label, name, allowed);
}

/* solids of second order are taken, linear ones to be raised */
static enum percuss_status msh_check_type(const struct msh *msh, int type)
{
    char number[LINE_SIZE];
    snprintf(number, sizeof number, "type %d", type);
    if (type <= 0 || (size_t)type >= sizeof TYPES / sizeof *TYPES)
        return refuse_type(msh, number, "one of second order (gmsh -order 2 makes it)");
    bool linear = type == MSH_TET4 || type == MSH_HEX8 || type == MSH_WEDGE6;
    bool second =
        type == MSH_TET10 || type == MSH_HEX20 || type == MSH_HEX27 || type == MSH_WEDGE15;
    if (TYPES[type].dimension < 3 || second || (linear && msh->builder.raise))
        return PERCUSS_OK;
    if (linear)
        return refuse_type(msh, TYPES[type].name,
                           "of second order, as linear ones are too stiff (first frequency 4 to 15 "
                           "% high): gmsh -order 2 makes it, --raise takes straight edges");
    return refuse_type(msh, TYPES[type].name,
                       "10-node tetrahedra, 20- or 27-node hexahedra, 15-node prisms "
                       "(Mesh.SecondOrderIncomplete=1 makes these)");
}

static enum element_type msh_element(int type)
{
    return type == MSH_TET10 || type == MSH_TET4       ? ELEMENT_TET10
           : type == MSH_HEX27                         ? ELEMENT_HEX27
           : type == MSH_WEDGE15 || type == MSH_WEDGE6 ? ELEMENT_WEDGE15
                                                       : ELEMENT_HEX20;
}

static enum percuss_status read_elements_of(struct msh *msh, int type, int entity, size_t count)
{
    struct scan *scan = &msh->scan;
    size_t nodes[ELEMENT_MOST_NODES], sets[MOST_ENTITY_TAGS], set_count = 0, label, part = 0;
    size_t node_count = TYPES[type].nodes;
    bool solid = TYPES[type].dimension == 3;
    /* solids make parts; faces, edges and points make sets of nodes */
    if (solid && (part = find_part(msh, entity)) == SIZE_MAX)
        return msh_out_of_memory(msh);
    msh->flat += solid ? 0 : count;
    if (!solid && find_sets(msh, TYPES[type].dimension, entity, sets, &set_count) != PERCUSS_OK)
        return PERCUSS_INTERNAL;
    /* each in Gmsh's order of nodes, which is the builder's */
    for (size_t i = 0; i < count; i++) {
        if (!scan_size(scan, "number of an element", &label))
            return PERCUSS_BAD_REQUEST;
        for (size_t k = 0; k < ELEMENT_MOST_NODES; k++) {
            nodes[k] = BUILDER_MIDDLE;
            if (k < node_count && !scan_size(scan, "node of an element", &nodes[k]))
                return PERCUSS_BAD_REQUEST;
        }
        if (solid ? !builder_add_element(&msh->builder, msh_element(type), label, part, nodes)
                  : !add_to_sets(msh, sets, set_count, nodes, node_count))
            return msh_out_of_memory(msh);
    }
    return PERCUSS_OK;
}

static enum percuss_status read_element_block(struct msh *msh)
{
    struct scan *scan = &msh->scan;
    int dimension, entity, type;
    size_t count;
    if (!scan_integer(scan, "dimension", &dimension) || !scan_integer(scan, "entity", &entity) ||
        !scan_integer(scan, "element type", &type) ||
        !scan_count(scan, "elements of a block", &count))
        return PERCUSS_BAD_REQUEST;
    enum percuss_status status = msh_check_type(msh, type);
    return status == PERCUSS_OK ? read_elements_of(msh, type, entity, count) : status;
}

/* $Nodes and $Elements: four counts, then blocks */
static enum percuss_status read_blocks(struct msh *msh,
                                       enum percuss_status (*read_block)(struct msh *))
{
    size_t blocks, count, least, most;
    if (!scan_count(&msh->scan, "blocks", &blocks) || !scan_size(&msh->scan, "total", &count) ||
        !scan_size(&msh->scan, "least number", &least) ||
        !scan_size(&msh->scan, "greatest number", &most))
        return PERCUSS_BAD_REQUEST;
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < blocks && status == PERCUSS_OK; i++)
        status = read_block(msh);
    return status;
}

/* skips "$End..." of the section `name` ("$Nodes") */
static enum percuss_status end_section(struct scan *scan, const char *name)
{
    char end[LINE_SIZE + 4], line[LINE_SIZE];
    snprintf(end, sizeof end, "$End%s", name + 1);
    char *found = memmem(scan->text + scan->at, scan->size - scan->at, end, strlen(end));
    if (!found)
        return scan_refuse(scan, "%s: must end with %s: is the file whole?", name, end);
    for (; scan->text + scan->at < found; scan->at++)
        scan->line += scan->text[scan->at] == '\n';
    scan_line(scan, line, sizeof line);
    return PERCUSS_OK;
}

static enum percuss_status read_section(struct msh *msh, const char *name)
{
    if (strcmp(name, "$MeshFormat") == 0)
        return msh_read_format(&msh->scan) ? PERCUSS_OK : PERCUSS_BAD_REQUEST;
    if (strcmp(name, "$PhysicalNames") == 0)
        return read_names(msh);
    if (strcmp(name, "$Entities") == 0)
        return read_entities(msh);
    if (strcmp(name, "$PartitionedEntities") == 0)
        return read_partitions(msh);
    if (strcmp(name, "$Nodes") == 0)
        return read_blocks(msh, read_node_block);
    if (strcmp(name, "$Elements") == 0)
        return read_blocks(msh, read_element_block);
    return PERCUSS_OK;
}

static void msh_trim(char *line)
{
    size_t length = strlen(line);
    while (length > 0 && (line[length - 1] == ' ' || line[length - 1] == '\t'))
        line[--length] = '\0';
}

static enum percuss_status read_sections(struct msh *msh)
{
    char name[LINE_SIZE];
    bool begun = false;
    enum percuss_status status = PERCUSS_OK;
    while (status == PERCUSS_OK && scan_line(&msh->scan, name, sizeof name)) {
        msh_trim(name);
        if (name[0] == '\0')
            continue;
        if (name[0] != '$' || (!begun && strcmp(name, "$MeshFormat") != 0))
            return scan_refuse(&msh->scan,
                               "%.40s: a mesh of Gmsh must begin with $MeshFormat, and sections "
                               "with $: is it another program's .msh?",
                               name);
        begun = true;
        status = read_section(msh, name);
        if (status == PERCUSS_OK)
            status = end_section(&msh->scan, name);
    }
    return status;
}

/* what a mesh of a surface alone lacks */
static enum percuss_status check_volume(const struct msh *msh)
{
    if (msh->builder.element_count > 0 || msh->flat == 0)
        return PERCUSS_OK;
    return fault_set(msh->scan.fault, PERCUSS_BAD_REQUEST,
                     "%s: has %zu faces, lines and points and no solid: must be meshed in three "
                     "dimensions (gmsh -3); where a physical group is defined, Gmsh saves groups "
                     "alone: add a Physical Volume, or set Mesh.SaveAll=1",
                     msh->file, msh->flat);
}

bool msh_is_readable(const char *path)
{
    char line[LINE_SIZE];
    double version = 0.0;
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return true;
    bool begun = fgets(line, sizeof line, stream) != NULL;
    bool old = begun && strncmp(line, "$NOD", 4) == 0;
    bool gmsh = begun && strncmp(line, "$MeshFormat", 11) == 0 &&
                fgets(line, sizeof line, stream) && sscanf(line, "%lf", &version) == 1;
    fclose(stream);
    return !old && (!gmsh || (version >= 4.1 && version < 4.2));
}

enum percuss_status msh_read(const struct msh_source *source, double unit, bool raise,
                             struct solid_mesh *mesh, struct fault *fault)
{
    struct msh msh = {.file = source->file, .made = source->made};
    char name[2 * LINE_SIZE];
    memset(mesh, 0, sizeof *mesh);
    msh.builder.raise = raise;
    enum percuss_status status = scan_open(source->path, &msh.scan, fault);
    if (status != PERCUSS_OK)
        return status;
    snprintf(name, sizeof name, "%s%s", source->file, source->made ? ": Gmsh's mesh of it" : "");
    msh.scan.file = name;
    status = read_sections(&msh);
    if (status == PERCUSS_OK)
        status = check_volume(&msh);
    if (status == PERCUSS_OK && msh.grouped && msh.alone[0] &&
        !builder_remark(&msh.builder, "in no physical group, and part of the body: %s", msh.alone))
        status = msh_out_of_memory(&msh);
    if (status == PERCUSS_OK)
        status = builder_finish(&msh.builder, source->file, unit, mesh, fault);
    scan_close(&msh.scan);
    builder_free(&msh.builder);
    msh_groups_free(&msh.groups);
    return status;
}
