/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "shapes/solid_shapes.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/element.h"

/* A body of curved boxes, each cut into cells; places in a box run from 0 to 1. */
struct boxes {
    size_t count;
    size_t (*cells)[3];
    double size[3]; /* block: sizes; cylinder: radius, core's half side, length */
    void (*map)(const struct boxes *boxes, size_t box, const double at[3], double point[3]);
};

static void *take(size_t size)
{
    void *memory = calloc(1, size);
    assert(memory);
    return memory;
}

static double (*sorted_points)[3];

static int by_place(const void *left, const void *right)
{
    const double *a = sorted_points[*(const size_t *)left],
                 *b = sorted_points[*(const size_t *)right];
    for (int k = 0; k < 3; k++)
        if (a[k] != b[k])
            return a[k] < b[k] ? -1 : 1;
    return 0;
}

/* Nodes at one place become one: places are compared after rounding to 1e-9 of the body. */
static void merge(struct solid_mesh *mesh, double extent)
{
    size_t count = mesh->node_count, kept = 0;
    size_t *order = take(count * sizeof *order), *now = take(count * sizeof *now);
    double(*rounded)[3] = take(count * sizeof *rounded);
    double(*points)[3] = take(count * sizeof *points);
    for (size_t i = 0; i < count; i++) {
        order[i] = i;
        for (int k = 0; k < 3; k++)
            rounded[i][k] = rint(mesh->points[i][k] / extent * 1e9);
    }
    sorted_points = rounded;
    qsort(order, count, sizeof *order, by_place);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || by_place(&order[i - 1], &order[i]) != 0)
            memcpy(points[kept++], mesh->points[order[i]], sizeof *points);
        now[order[i]] = kept - 1;
    }
    for (size_t i = 0; i < count; i++)
        mesh->nodes[i] = now[mesh->nodes[i]];
    free(mesh->points);
    mesh->points = points;
    mesh->node_count = kept;
    free(order);
    free(now);
    free(rounded);
}

/* The corners of tetrahedron `t` of 24 in a cell: two of a face's, its middle, the cell's middle.
 */
static void tet_corners(size_t t, double corners[4][3])
{
    size_t axis = t / 8, side = t / 4 % 2, edge = t % 4;
    size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    static const double around[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    for (size_t c = 0; c < 4; c++) {
        /* seen from the middle the edge runs one way on one side, the other on the other */
        size_t e = c < 2 ? (side ? edge + 1 - c : edge + c) : 0;
        corners[c][axis] = c == 3 ? 0.5 : (double)side;
        corners[c][u] = c < 2 ? around[e][0] : 0.5;
        corners[c][v] = c < 2 ? around[e][1] : 0.5;
    }
}

/* Into how many pieces a cell is cut. */
static size_t pieces_of(enum element_type type)
{
    return type == ELEMENT_TET10 ? 24 : type == ELEMENT_WEDGE15 ? 2 : 1;
}

/* Place of a node of piece `t` in its cell. */
static void place_in_cell(enum element_type type, size_t t, size_t node, double at[3])
{
    double natural[3], corners[4][3];
    element_node(type, node, natural);
    if (type == ELEMENT_WEDGE15) {
        /* along the first direction, which all boxes of a shape share: their faces fit */
        for (int k = 0; k < 2; k++)
            at[1 + k] = t ? 1.0 - natural[k] : natural[k];
        at[0] = 0.5 + 0.5 * natural[2];
        return;
    }
    if (type != ELEMENT_TET10) {
        for (int k = 0; k < 3; k++)
            at[k] = 0.5 + 0.5 * natural[k];
        return;
    }
    tet_corners(t, corners);
    for (int k = 0; k < 3; k++)
        at[k] = corners[0][k] + natural[0] * (corners[1][k] - corners[0][k]) +
                natural[1] * (corners[2][k] - corners[0][k]) +
                natural[2] * (corners[3][k] - corners[0][k]);
}

/* Adds the elements of one cell, each with nodes of its own. */
static void add_cell(enum element_type type, const struct boxes *boxes, size_t box,
                     const size_t cell[3], struct solid_mesh *mesh)
{
    size_t pieces = pieces_of(type), nodes = element_node_count(type);
    for (size_t t = 0; t < pieces; t++) {
        for (size_t n = 0; n < nodes; n++) {
            double at[3];
            place_in_cell(type, t, n, at);
            for (int k = 0; k < 3; k++)
                at[k] = ((double)cell[k] + at[k]) / (double)boxes->cells[box][k];
            boxes->map(boxes, box, at, mesh->points[mesh->node_count]);
            mesh->nodes[mesh->node_count] = mesh->node_count;
            mesh->node_count++;
        }
        mesh->types[mesh->element_count++] = (unsigned char)type;
        mesh->first[mesh->element_count] = mesh->node_count;
    }
}

static void name_end(struct solid_mesh *mesh, struct mesh_set *set, const char *name, double x)
{
    strcpy(set->name, name);
    set->nodes = take(mesh->node_count * sizeof *set->nodes);
    for (size_t i = 0; i < mesh->node_count; i++)
        if (fabs(mesh->points[i][0] - x) < 1e-9)
            set->nodes[set->count++] = i;
}

static void build(enum element_type type, const struct boxes *boxes, double length,
                  const struct material *material, struct solid_mesh *mesh)
{
    size_t elements = 0, pieces = pieces_of(type);
    for (size_t b = 0; b < boxes->count; b++)
        elements += pieces * boxes->cells[b][0] * boxes->cells[b][1] * boxes->cells[b][2];
    size_t nodes = elements * element_node_count(type);
    *mesh = (struct solid_mesh){.unit = 1.0, .part_count = 1, .set_count = 2};
    mesh->points = take(nodes * sizeof *mesh->points);
    mesh->types = take(elements);
    mesh->first = take((elements + 1) * sizeof *mesh->first);
    mesh->nodes = take(nodes * sizeof *mesh->nodes);
    mesh->parts = take(elements * sizeof *mesh->parts);
    for (size_t b = 0; b < boxes->count; b++)
        for (size_t i = 0; i < boxes->cells[b][0]; i++)
            for (size_t j = 0; j < boxes->cells[b][1]; j++)
                for (size_t k = 0; k < boxes->cells[b][2]; k++)
                    add_cell(type, boxes, b, (size_t[3]){i, j, k}, mesh);
    merge(mesh, fmax(length, fmax(boxes->size[0], boxes->size[1])));
    /* names and labels */
    mesh->labels = take(mesh->node_count * sizeof *mesh->labels);
    mesh->element_labels = take(elements * sizeof *mesh->element_labels);
    for (size_t i = 0; i < mesh->node_count; i++)
        mesh->labels[i] = i + 1;
    for (size_t e = 0; e < elements; e++)
        mesh->element_labels[e] = e + 1;
    mesh->part = take(sizeof *mesh->part);
    strcpy(mesh->part->name, "body");
    mesh->part->has_material = true;
    mesh->part->material = *material;
    mesh->set = take(2 * sizeof *mesh->set);
    name_end(mesh, &mesh->set[0], "low", 0.0);
    name_end(mesh, &mesh->set[1], "high", length);
}

static void map_block(const struct boxes *boxes, size_t box, const double at[3], double point[3])
{
    (void)box;
    for (int k = 0; k < 3; k++)
        point[k] = at[k] * boxes->size[k];
}

void solid_shape_block(enum element_type type, const double size[3], const size_t cells[3],
                       const struct material *material, struct solid_mesh *mesh)
{
    size_t copy[1][3] = {{cells[0], cells[1], cells[2]}};
    struct boxes boxes = {1, copy, {size[0], size[1], size[2]}, map_block};
    build(type, &boxes, size[0], material, mesh);
}

/* Box 0 is the core, the others join its sides to the rim: along x, around, outwards. */
static void map_cylinder(const struct boxes *boxes, size_t box, const double at[3], double point[3])
{
    double radius = boxes->size[0], half = boxes->size[1], around = 2.0 * at[1] - 1.0;
    point[0] = at[0] * boxes->size[2];
    if (box == 0) {
        point[1] = half * around;
        point[2] = half * (2.0 * at[2] - 1.0);
        return;
    }
    double angle = 0.25 * M_PI * around, turn = 0.5 * M_PI * (double)box;
    double y = (1.0 - at[2]) * half + at[2] * radius * cos(angle);
    double z = (1.0 - at[2]) * half * around + at[2] * radius * sin(angle);
    /* so that x, around, outwards is right-handed */
    point[1] = cos(turn) * y + sin(turn) * z;
    point[2] = sin(turn) * y - cos(turn) * z;
}

void solid_shape_cylinder(enum element_type type, const double radius_length[2],
                          const size_t core_rings_along[3], const struct material *material,
                          struct solid_mesh *mesh)
{
    size_t core = 2 * core_rings_along[0], along = core_rings_along[2];
    size_t cells[5][3] = {{along, core, core}};
    for (size_t b = 1; b < 5; b++)
        memcpy(cells[b], (size_t[3]){along, core, core_rings_along[1]}, sizeof cells[b]);
    /* corners of the core lie at 0.71 of the radius */
    struct boxes boxes = {
        5, cells, {radius_length[0], 0.5 * radius_length[0], radius_length[1]}, map_cylinder};
    build(type, &boxes, radius_length[1], material, mesh);
}
