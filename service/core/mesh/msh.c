/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/msh.h"

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

/* Zeroed to begin with; owns its arrays. */
struct msh_groups {
    size_t group_count, group_room, member_count, member_room;
    struct msh_group *groups;
    struct msh_member *members;
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
    memset(groups, 0, sizeof *groups);
}

/* ---- the file ---- */

enum { LINE_SIZE = 256, MOST_ENTITY_TAGS = 4 };

/* Gmsh's numbers of types of elements; 0 nodes: unknown */
enum { MSH_TET4 = 4, MSH_HEX8 = 5, MSH_TET10 = 11, MSH_HEX27 = 12, MSH_HEX20 = 17 };
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
        if (sscanf(line, "%d %d \"%63[^\"]", &group.dimension, &group.tag, group.name) != 3)
            return scan_refuse(scan, "physical name: must be: dimension tag \"name\"");
        if (!msh_groups_add(&msh->groups, &group))
            return msh_out_of_memory(msh);
    }
    scan->binary = binary;
    return PERCUSS_OK;
}

/* one point, curve, surface or volume: its box, its physical groups, its boundary */
static enum percuss_status read_entity(struct msh *msh, int dimension)
{
    struct scan *scan = &msh->scan;
    int entity, tag;
    double box;
    size_t count;
    /* its number; its box is not used */
    if (!scan_integer(scan, "entity", &entity))
        return PERCUSS_BAD_REQUEST;
    for (int i = 0; i < (dimension == 0 ? 3 : 6); i++)
        if (!scan_real(scan, "entity's box", &box))
            return PERCUSS_BAD_REQUEST;
    /* the groups it belongs to */
    if (!scan_count(scan, "entity's physical groups", &count))
        return PERCUSS_BAD_REQUEST;
    for (size_t i = 0; i < count; i++) {
        if (!scan_integer(scan, "physical group", &tag))
            return PERCUSS_BAD_REQUEST;
        if (!msh_groups_join(&msh->groups, (struct msh_member){dimension, entity, tag}))
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

/* the first physical group of a volume, else the volume itself */
static size_t find_part(struct msh *msh, int entity)
{
    char name[MESH_NAME_SIZE];
    int tag;
    if (msh_groups_of(&msh->groups, 3, entity, &tag, 1) == 1)
        msh_groups_name(&msh->groups, 3, tag, name);
    else
        snprintf(name, sizeof name, "volume %d", entity);
    return builder_part(&msh->builder, name);
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

/* only solids of second order are taken */
static enum percuss_status msh_check_type(const struct scan *scan, int type)
{
    if (type <= 0 || (size_t)type >= sizeof TYPES / sizeof *TYPES)
        return scan_refuse(
            scan, "element type %d: must be one of second order (gmsh -order 2 makes it)", type);
    if (TYPES[type].dimension < 3 || type == MSH_TET10 || type == MSH_HEX20 || type == MSH_HEX27)
        return PERCUSS_OK;
    if (type == MSH_TET4 || type == MSH_HEX8)
        return scan_refuse(scan,
                           "%s: must be of second order, as linear ones are too stiff (first "
                           "frequency 4 to 15 %% high): gmsh -order 2 makes it",
                           TYPES[type].name);
    return scan_refuse(scan, "%s: must be 10-node tetrahedra, 20- or 27-node hexahedra",
                       TYPES[type].name);
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
    if (!solid && find_sets(msh, TYPES[type].dimension, entity, sets, &set_count) != PERCUSS_OK)
        return PERCUSS_INTERNAL;
    /* each in Gmsh's order of nodes, which is the builder's */
    for (size_t i = 0; i < count; i++) {
        if (!scan_size(scan, "number of an element", &label))
            return PERCUSS_BAD_REQUEST;
        for (size_t k = 0; k < node_count; k++)
            if (!scan_size(scan, "node of an element", &nodes[k]))
                return PERCUSS_BAD_REQUEST;
        enum element_type kind = type == MSH_TET10   ? ELEMENT_TET10
                                 : type == MSH_HEX20 ? ELEMENT_HEX20
                                                     : ELEMENT_HEX27;
        if (solid ? !builder_add_element(&msh->builder, kind, label, part, nodes)
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
    enum percuss_status status = msh_check_type(scan, type);
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
            return scan_refuse(&msh->scan, "must begin with $MeshFormat, and sections with $");
        begun = true;
        status = read_section(msh, name);
        if (status == PERCUSS_OK)
            status = end_section(&msh->scan, name);
    }
    return status;
}

bool msh_is_readable(const char *path)
{
    char line[LINE_SIZE];
    double version = 0.0;
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return true;
    bool gmsh = fgets(line, sizeof line, stream) && strncmp(line, "$MeshFormat", 11) == 0 &&
                fgets(line, sizeof line, stream) && sscanf(line, "%lf", &version) == 1;
    fclose(stream);
    return !gmsh || (version >= 4.1 && version < 4.2);
}

enum percuss_status msh_read(const char *path, const char *file, double unit,
                             struct solid_mesh *mesh, struct fault *fault)
{
    struct msh msh = {0};
    memset(mesh, 0, sizeof *mesh);
    enum percuss_status status = scan_open(path, &msh.scan, fault);
    if (status != PERCUSS_OK)
        return status;
    msh.scan.file = file;
    status = read_sections(&msh);
    if (status == PERCUSS_OK)
        status = builder_finish(&msh.builder, file, unit, mesh, fault);
    scan_close(&msh.scan);
    builder_free(&msh.builder);
    msh_groups_free(&msh.groups);
    return status;
}
