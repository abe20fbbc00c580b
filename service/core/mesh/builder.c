/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/builder.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/bulk.h"
#include "mesh/element.h"
#include "mesh/grow.h"

/* a node's label and its place in the list of nodes */
struct label {
    size_t label, index;
};

/* nodes found by label, and their numbers in the mesh (SIZE_MAX: in no element) */
struct index {
    size_t count;
    struct label *labels; /* ascending */
    size_t *numbers;      /* [count], by place in the list of nodes */
};

bool builder_append(struct builder_list *list, size_t value)
{
    if (!GROW(list->values, list->count, list->room))
        return false;
    list->values[list->count++] = value;
    return true;
}

bool builder_add_node(struct builder *builder, size_t label, const double point[3])
{
    if (!GROW(builder->nodes, builder->node_count, builder->node_room))
        return false;
    struct builder_node *node = &builder->nodes[builder->node_count++];
    node->label = label;
    memcpy(node->point, point, sizeof node->point);
    return true;
}

bool builder_add_element(struct builder *builder, enum element_type type, size_t label, size_t part,
                         const size_t *nodes)
{
    size_t first = builder->connectivity.count;
    if (!GROW(builder->elements, builder->element_count, builder->element_room))
        return false;
    for (size_t i = 0; i < element_node_count(type); i++)
        if (!builder_append(&builder->connectivity, nodes[i]))
            return false;
    builder->elements[builder->element_count++] =
        (struct builder_element){label, first, part, (unsigned char)type};
    return true;
}

bool builder_add_mass(struct builder *builder, size_t label, double mass)
{
    if (!GROW(builder->masses, builder->mass_count, builder->mass_room))
        return false;
    builder->masses[builder->mass_count++] = (struct builder_mass){label, mass};
    return true;
}

static void copy_name(char to[MESH_NAME_SIZE], const char *from)
{
    snprintf(to, MESH_NAME_SIZE, "%s", from);
}

size_t builder_part(struct builder *builder, const char *name)
{
    char cut[MESH_NAME_SIZE];
    copy_name(cut, name);
    for (size_t i = 0; i < builder->part_count; i++)
        if (strcmp(builder->parts[i].name, cut) == 0)
            return i;
    if (!GROW(builder->parts, builder->part_count, builder->part_room))
        return SIZE_MAX;
    struct mesh_part *part = &builder->parts[builder->part_count];
    memset(part, 0, sizeof *part);
    memcpy(part->name, cut, sizeof cut);
    part->material.young = part->material.poisson = part->material.density = NAN;
    part->material.yield = INFINITY;
    return builder->part_count++;
}

size_t builder_set(struct builder *builder, const char *name)
{
    char cut[MESH_NAME_SIZE];
    copy_name(cut, name);
    for (size_t i = 0; i < builder->set_count; i++)
        if (strcmp(builder->sets[i].name, cut) == 0)
            return i;
    return builder_add_set(builder, cut);
}

size_t builder_add_set(struct builder *builder, const char *name)
{
    if (!GROW(builder->sets, builder->set_count, builder->set_room))
        return SIZE_MAX;
    struct builder_set *set = &builder->sets[builder->set_count];
    memset(set, 0, sizeof *set);
    copy_name(set->name, name);
    return builder->set_count++;
}

bool builder_remark(struct builder *builder, const char *format, ...)
{
    if (!GROW(builder->remarks, builder->remark_count, builder->remark_room))
        return false;
    va_list args;
    va_start(args, format);
    vsnprintf(builder->remarks[builder->remark_count++], MESH_REMARK_SIZE, format, args);
    va_end(args);
    return true;
}

static int compare_labels(const void *left, const void *right)
{
    const struct label *a = left, *b = right;
    if (a->label != b->label)
        return a->label < b->label ? -1 : 1;
    return a->index < b->index ? -1 : a->index > b->index;
}

static int compare_sizes(const void *left, const void *right)
{
    size_t a = *(const size_t *)left, b = *(const size_t *)right;
    return a < b ? -1 : a > b;
}

/* the place of a label among the nodes; SIZE_MAX: there is none */
static size_t builder_find(const struct index *index, size_t label)
{
    size_t low = 0, high = index->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (index->labels[middle].label < label)
            low = middle + 1;
        else
            high = middle;
    }
    return low < index->count && index->labels[low].label == label ? index->labels[low].index
                                                                   : SIZE_MAX;
}

static enum percuss_status builder_out_of_memory(const char *file, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", file);
}

static bool same_point(const struct builder *builder, size_t one, size_t other)
{
    const double *a = builder->nodes[one].point, *b = builder->nodes[other].point;
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static enum percuss_status refuse_node(const struct builder *builder, size_t one, size_t other,
                                       const char *file, struct fault *fault)
{
    const double *a = builder->nodes[one].point, *b = builder->nodes[other].point;
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%s: node %zu: is there twice, at %g, %g, %g and at %g, %g, %g: each must have "
        "a number of its own",
        file, builder->nodes[one].label, a[0], a[1], a[2], b[0], b[1], b[2]);
}

static enum percuss_status make_index(const struct builder *builder, const char *file,
                                      struct index *index, struct fault *fault)
{
    /* sort labels with their places; no node is numbered yet */
    index->count = builder->node_count;
    index->labels = malloc((index->count + 1) * sizeof *index->labels);
    index->numbers = malloc((index->count + 1) * sizeof *index->numbers);
    if (!index->labels || !index->numbers)
        return builder_out_of_memory(file, fault);
    for (size_t i = 0; i < index->count; i++) {
        index->labels[i] = (struct label){builder->nodes[i].label, i};
        index->numbers[i] = SIZE_MAX;
    }
    qsort(index->labels, index->count, sizeof *index->labels, compare_labels);
    /* a label has one place; the same once more is dropped */
    size_t kept = 0;
    for (size_t i = 0; i < index->count; i++) {
        const struct label *last = kept ? &index->labels[kept - 1] : NULL;
        if (!last || last->label != index->labels[i].label)
            index->labels[kept++] = index->labels[i];
        else if (!same_point(builder, last->index, index->labels[i].index))
            return refuse_node(builder, last->index, index->labels[i].index, file, fault);
    }
    index->count = kept;
    return PERCUSS_OK;
}

/* refuses a label of two elements; they may come in any order */
static enum percuss_status check_elements(const struct builder *builder, const char *file,
                                          struct fault *fault)
{
    size_t count = builder->element_count, *labels = malloc((count + 1) * sizeof *labels);
    if (!labels)
        return builder_out_of_memory(file, fault);
    for (size_t i = 0; i < count; i++)
        labels[i] = builder->elements[i].label;
    qsort(labels, count, sizeof *labels, compare_sizes);
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 1; i < count && status == PERCUSS_OK; i++)
        if (labels[i] == labels[i - 1])
            status =
                fault_set(fault, PERCUSS_BAD_REQUEST,
                          "%s: element %zu: is there twice: each must have a number of its own",
                          file, labels[i]);
    free(labels);
    return status;
}

/* ---- mid nodes that a file of linear elements lacks ---- */

/* An edge of an element by the labels of its ends; edges of neighbours are equal. */
struct edge {
    size_t low, high;
    size_t middle; /* its mid node, BUILDER_MIDDLE: to be made */
    size_t at;     /* where the mid node stands in the connectivity */
};

struct edges {
    size_t count, room;
    struct edge *list;
};

/* by ends; a mid node that the file has comes before those to be made */
static int compare_edges(const void *left, const void *right)
{
    const struct edge *a = left, *b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    if (a->middle != b->middle)
        return a->middle < b->middle ? -1 : 1;
    return a->at < b->at ? -1 : a->at > b->at;
}

/* all edges, sorted */
static bool collect_edges(const struct builder *builder, struct edges *edges)
{
    for (size_t e = 0; e < builder->element_count; e++) {
        const struct builder_element *element = &builder->elements[e];
        const size_t *nodes = builder->connectivity.values + element->first;
        size_t corners = element_corner_count(element->type), ends[2];
        for (size_t i = corners; i < element_node_count(element->type); i++) {
            if (!element_edge(element->type, i, ends))
                continue;
            if (!GROW(edges->list, edges->count, edges->room))
                return false;
            size_t a = nodes[ends[0]], b = nodes[ends[1]];
            edges->list[edges->count++] =
                (struct edge){a < b ? a : b, a < b ? b : a, nodes[i], element->first + i};
        }
    }
    qsort(edges->list, edges->count, sizeof *edges->list, compare_edges);
    return true;
}

/* whether sorted labels have one */
static bool has_label(const size_t *labels, size_t count, size_t label)
{
    return bsearch(&label, labels, count, sizeof *labels, compare_sizes) != NULL;
}

/* a set of both ends of an edge has the middle that was made of it */
static bool add_middles_to_sets(struct builder *builder, const struct edges *edges)
{
    for (size_t s = 0; s < builder->set_count; s++) {
        struct builder_list *labels = &builder->sets[s].labels;
        size_t count = labels->count;
        if (count == 0)
            continue;
        qsort(labels->values, count, sizeof *labels->values, compare_sizes);
        for (size_t i = 0; i < edges->count; i++) {
            const struct edge *edge = &edges->list[i];
            if (edge->middle == BUILDER_MIDDLE && has_label(labels->values, count, edge->low) &&
                has_label(labels->values, count, edge->high) &&
                !builder_append(labels, builder->connectivity.values[edge->at]))
                return false;
        }
    }
    return true;
}

/* gives each edge without a mid node one, with labels behind those of the file */
static enum percuss_status place_middles(struct builder *builder, const struct edges *edges,
                                         const char *file, const struct index *index,
                                         struct fault *fault)
{
    size_t label = index->count ? index->labels[index->count - 1].label : 0;
    for (size_t i = 0; i < edges->count; i++) {
        const struct edge *edge = &edges->list[i], *before = i ? &edges->list[i - 1] : NULL;
        size_t *middle = &builder->connectivity.values[edge->at];
        if (edge->middle != BUILDER_MIDDLE)
            continue;
        /* the neighbours' */
        if (before && before->low == edge->low && before->high == edge->high) {
            *middle = builder->connectivity.values[before->at];
            continue;
        }
        size_t low = builder_find(index, edge->low), high = builder_find(index, edge->high);
        double point[3] = {0.0, 0.0, 0.0};
        for (int k = 0; k < 3 && low != SIZE_MAX && high != SIZE_MAX; k++)
            point[k] = 0.5 * (builder->nodes[low].point[k] + builder->nodes[high].point[k]);
        if (label >= BUILDER_MIDDLE - 1 || !builder_add_node(builder, ++label, point))
            return builder_out_of_memory(file, fault);
        *middle = label;
    }
    return PERCUSS_OK;
}

/* replaces every BUILDER_MIDDLE */
static enum percuss_status make_middles(struct builder *builder, const char *file,
                                        struct fault *fault)
{
    struct edges edges = {0};
    struct index index = {0};
    size_t lacking = 0;
    for (size_t i = 0; i < builder->connectivity.count; i++)
        lacking += builder->connectivity.values[i] == BUILDER_MIDDLE;
    if (lacking == 0)
        return PERCUSS_OK;
    enum percuss_status status = make_index(builder, file, &index, fault);
    if (status == PERCUSS_OK && !collect_edges(builder, &edges))
        status = builder_out_of_memory(file, fault);
    if (status == PERCUSS_OK)
        status = place_middles(builder, &edges, file, &index, fault);
    if (status == PERCUSS_OK &&
        !(add_middles_to_sets(builder, &edges) &&
          builder_remark(builder,
                         "linear elements were raised to second order with straight edges: "
                         "round surfaces are as flat between corners as in the file, their "
                         "volume and curvature are those of the facets")))
        status = builder_out_of_memory(file, fault);
    free(edges.list);
    free(index.labels);
    free(index.numbers);
    return status;
}

/* ---- the mesh ---- */

static enum percuss_status builder_allocate_mesh(const struct builder *builder, const char *file,
                                                 struct solid_mesh *mesh, struct fault *fault)
{
    size_t elements = builder->element_count, nodes = builder->connectivity.count;
    mesh->points = malloc((builder->node_count + 1) * sizeof *mesh->points);
    mesh->labels = malloc((builder->node_count + 1) * sizeof *mesh->labels);
    mesh->types = malloc(elements + 1);
    mesh->first = malloc((elements + 1) * sizeof *mesh->first);
    mesh->nodes = malloc((nodes + 1) * sizeof *mesh->nodes);
    mesh->parts = malloc((elements + 1) * sizeof *mesh->parts);
    mesh->element_labels = malloc((elements + 1) * sizeof *mesh->element_labels);
    mesh->part = calloc(builder->part_count + 1, sizeof *mesh->part);
    mesh->set = calloc(builder->set_count + 1, sizeof *mesh->set);
    return mesh->points && mesh->labels && mesh->types && mesh->first && mesh->nodes &&
                   mesh->parts && mesh->element_labels && mesh->part && mesh->set
               ? PERCUSS_OK
               : builder_out_of_memory(file, fault);
}

/* elements in the order of the file, nodes in the order of their first use */
static enum percuss_status place_elements(const struct builder *builder, const char *file,
                                          struct index *index, struct solid_mesh *mesh,
                                          struct fault *fault)
{
    for (size_t e = 0; e < builder->element_count; e++) {
        const struct builder_element *element = &builder->elements[e];
        size_t count = element_node_count(element->type);
        /* its type, part and label */
        mesh->types[e] = element->type;
        mesh->first[e] = element->first;
        mesh->parts[e] = element->part;
        mesh->element_labels[e] = element->label;
        /* its nodes by number; a new node gets the next one */
        for (size_t i = element->first; i < element->first + count; i++) {
            size_t at = builder_find(index, builder->connectivity.values[i]);
            if (at == SIZE_MAX)
                return fault_set(fault, PERCUSS_BAD_REQUEST,
                                 "%s: element %zu: node %zu: must be one of the file's nodes", file,
                                 element->label, builder->connectivity.values[i]);
            if (index->numbers[at] == SIZE_MAX)
                index->numbers[at] = mesh->node_count++;
            mesh->nodes[i] = index->numbers[at];
        }
        mesh->element_count++;
        mesh->first[e + 1] = element->first + count;
    }
    return PERCUSS_OK;
}

static enum percuss_status place_nodes(const struct builder *builder, const char *file,
                                       const struct index *index, struct solid_mesh *mesh,
                                       struct fault *fault)
{
    for (size_t i = 0; i < builder->node_count; i++) {
        const struct builder_node *node = &builder->nodes[i];
        size_t number = index->numbers[i];
        if (number == SIZE_MAX)
            continue;
        mesh->labels[number] = node->label;
        for (int k = 0; k < 3; k++) {
            mesh->points[number][k] = mesh->unit * node->point[k];
            if (!isfinite(mesh->points[number][k]))
                return fault_set(fault, PERCUSS_BAD_REQUEST,
                                 "%s: node %zu: %g: coordinates must be finite numbers", file,
                                 node->label, node->point[k]);
        }
    }
    return PERCUSS_OK;
}

/* parts that have elements, numbered anew */
static bool place_parts(const struct builder *builder, struct solid_mesh *mesh)
{
    size_t *numbers = malloc((builder->part_count + 1) * sizeof *numbers);
    if (!numbers)
        return false;
    for (size_t i = 0; i < builder->part_count; i++)
        numbers[i] = SIZE_MAX;
    for (size_t e = 0; e < mesh->element_count; e++) {
        size_t old = mesh->parts[e];
        if (numbers[old] == SIZE_MAX) {
            numbers[old] = mesh->part_count;
            mesh->part[mesh->part_count++] = builder->parts[old];
        }
        mesh->parts[e] = numbers[old];
    }
    free(numbers);
    return true;
}

/* sets keep nodes of elements, ascending and once each; empty sets are dropped */
static bool place_sets(const struct builder *builder, const struct index *index,
                       struct solid_mesh *mesh)
{
    for (size_t s = 0; s < builder->set_count; s++) {
        /* the labels of nodes that an element uses */
        const struct builder_list *labels = &builder->sets[s].labels;
        struct mesh_set *set = &mesh->set[mesh->set_count];
        size_t *nodes = malloc((labels->count + 1) * sizeof *nodes), count = 0;
        if (!nodes)
            return false;
        for (size_t i = 0; i < labels->count; i++) {
            size_t at = builder_find(index, labels->values[i]);
            if (at != SIZE_MAX && index->numbers[at] != SIZE_MAX)
                nodes[count++] = index->numbers[at];
        }
        /* ascending and once each, in place */
        qsort(nodes, count, sizeof *nodes, compare_sizes);
        for (size_t i = 0; i < count; i++)
            if (i == 0 || nodes[i] != nodes[i - 1])
                nodes[set->count++] = nodes[i];
        /* drop an empty set; the mesh owns the nodes of others */
        if (set->count == 0) {
            free(nodes);
            continue;
        }
        set->nodes = nodes;
        set->kind = builder->sets[s].kind;
        memcpy(set->name, builder->sets[s].name, sizeof set->name);
        memcpy(set->scope, builder->sets[s].scope, sizeof set->scope);
        memcpy(set->instance, builder->sets[s].instance, sizeof set->instance);
        mesh->set_count++;
    }
    return true;
}

static int compare_masses(const void *left, const void *right)
{
    const struct mesh_mass *a = left, *b = right;
    if (a->node != b->node)
        return a->node < b->node ? -1 : 1;
    return a->mass < b->mass ? -1 : a->mass > b->mass;
}

/* masses on nodes of elements, one a node */
static bool place_masses(struct builder *builder, const struct index *index,
                         struct solid_mesh *mesh)
{
    double taken = 0.0, left = 0.0;
    size_t first_left = SIZE_MAX, count = 0;
    mesh->masses = malloc((builder->mass_count + 1) * sizeof *mesh->masses);
    if (!mesh->masses)
        return false;
    for (size_t i = 0; i < builder->mass_count; i++) {
        size_t label = builder->masses[i].label, at = builder_find(index, label);
        size_t node = at == SIZE_MAX ? SIZE_MAX : index->numbers[at];
        double mass = builder->masses[i].mass / mesh->unit;
        if (node != SIZE_MAX) {
            mesh->masses[count++] = (struct mesh_mass){node, mass};
            taken += mass;
            continue;
        }
        left += mass;
        first_left = first_left == SIZE_MAX ? label : first_left;
    }
    /* in the order of nodes, those of one added up in place */
    qsort(mesh->masses, count, sizeof *mesh->masses, compare_masses);
    for (size_t i = 0; i < count; i++) {
        struct mesh_mass *last = mesh->mass_count ? &mesh->masses[mesh->mass_count - 1] : NULL;
        if (last && last->node == mesh->masses[i].node)
            last->mass += mesh->masses[i].mass;
        else
            mesh->masses[mesh->mass_count++] = mesh->masses[i];
    }
    if (first_left != SIZE_MAX &&
        !builder_remark(builder,
                        "masses on nodes that no element has (node %zu first) are left out: the "
                        "body here is lighter by %g kg",
                        first_left, left))
        return false;
    return mesh->mass_count == 0 ||
           builder_remark(builder,
                          "masses on nodes (%zu, of %g kg in all) are part of the body, each rigid "
                          "on its node alone: closer to one than an element the body's flexibility "
                          "is not known",
                          mesh->mass_count, taken);
}

/* an element's nodes the other way round: its first two natural coordinates change places */
static void turn_over(enum element_type type, size_t *nodes)
{
    size_t count = element_node_count(type), turned[ELEMENT_MOST_NODES];
    for (size_t i = 0; i < count; i++) {
        double at[3], other[3];
        element_node(type, i, at);
        for (size_t j = 0; j < count; j++) {
            element_node(type, j, other);
            if (other[0] == at[1] && other[1] == at[0] && other[2] == at[2])
                turned[i] = nodes[j];
        }
    }
    memcpy(nodes, turned, count * sizeof *nodes);
}

/* Elements whose nodes run the wrong way round, as in a mirrored mesh or a group that is turned
 * over in Gmsh, are the same elements the other way round. Those that are folded stay as they are.
 */
static bool turn_elements(struct builder *builder, struct solid_mesh *mesh)
{
    size_t count = 0, first = 0;
    for (size_t e = 0; e < mesh->element_count; e++) {
        double volume;
        size_t *nodes = mesh->nodes + mesh->first[e];
        bulk_element_det(mesh, e, &volume);
        if (!(volume < 0.0))
            continue;
        turn_over(mesh->types[e], nodes);
        if (!(bulk_element_det(mesh, e, &volume) > 0.0))
            turn_over(mesh->types[e], nodes);
        else if (builder->wedges_either_way && mesh->types[e] == ELEMENT_WEDGE15)
            continue;
        else if (count++ == 0)
            first = mesh->element_labels[e];
    }
    return count == 0 ||
           builder_remark(builder,
                          "%zu elements (element %zu first) had their nodes the wrong "
                          "way round, as in a mirrored mesh: they were turned over",
                          count, first);
}

static bool place_remarks(const struct builder *builder, struct solid_mesh *mesh)
{
    mesh->remarks = malloc((builder->remark_count + 1) * sizeof *mesh->remarks);
    if (!mesh->remarks)
        return false;
    mesh->remark_count = builder->remark_count;
    for (size_t i = 0; i < builder->remark_count; i++)
        memcpy(mesh->remarks[i], builder->remarks[i], sizeof mesh->remarks[i]);
    return true;
}

enum percuss_status builder_finish(struct builder *builder, const char *file, double unit,
                                   struct solid_mesh *mesh, struct fault *fault)
{
    /* refuse a mesh without elements */
    struct index index = {0};
    memset(mesh, 0, sizeof *mesh);
    mesh->unit = unit;
    enum percuss_status status = PERCUSS_OK;
    if (builder->element_count == 0)
        status =
            fault_set(fault, PERCUSS_BAD_REQUEST,
                      "%s: no solid elements: must have 10-node tetrahedra, 15-node "
                      "wedges, 20- or 27-node hexahedra (does the file hold the surface only?)",
                      file);
    /* each step needs the one before; elements number the nodes that they use */
    if (status == PERCUSS_OK)
        status = make_middles(builder, file, fault);
    if (status == PERCUSS_OK)
        status = make_index(builder, file, &index, fault);
    if (status == PERCUSS_OK)
        status = check_elements(builder, file, fault);
    if (status == PERCUSS_OK)
        status = builder_allocate_mesh(builder, file, mesh, fault);
    if (status == PERCUSS_OK)
        status = place_elements(builder, file, &index, mesh, fault);
    if (status == PERCUSS_OK)
        status = place_nodes(builder, file, &index, mesh, fault);
    if (status == PERCUSS_OK && !(place_parts(builder, mesh) && place_sets(builder, &index, mesh)))
        status = builder_out_of_memory(file, fault);
    if (status == PERCUSS_OK && !(place_masses(builder, &index, mesh) &&
                                  turn_elements(builder, mesh) && place_remarks(builder, mesh)))
        status = builder_out_of_memory(file, fault);
    /* an error frees the unfinished mesh */
    free(index.labels);
    free(index.numbers);
    if (status != PERCUSS_OK)
        solid_mesh_free(mesh);
    return status;
}

void builder_free(struct builder *builder)
{
    free(builder->nodes);
    free(builder->elements);
    free(builder->connectivity.values);
    free(builder->parts);
    for (size_t i = 0; i < builder->set_count; i++)
        free(builder->sets[i].labels.values);
    free(builder->sets);
    free(builder->masses);
    free(builder->remarks);
    memset(builder, 0, sizeof *builder);
}
