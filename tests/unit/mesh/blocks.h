/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Meshes made in C: the unit cube cut into n x n' x n'' cells, and mapped to what is wanted. */
#ifndef PERCUSS_TEST_BLOCKS_H
#define PERCUSS_TEST_BLOCKS_H

#include <string.h>

#include "check.h"
#include "mesh/solid_mesh.h"

struct block {
    enum element_type type; /* TET10: six in a cell */
    size_t cells[3];
    void (*map)(const double cube[3], double point[3]); /* must keep the orientation */
    bool straight; /* mid nodes in the middle of the chord, as meshers do without a geometry */
};

/* corners of a cell, Gmsh's edges and faces of a hexahedron as doubled coordinates 0, 1, 2 */
static const unsigned char BLOCK_HEX[27][3] = {
    {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
    {0, 2, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0},
    {2, 2, 1}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}, {2, 1, 2}, {1, 2, 2}, {1, 1, 0},
    {1, 0, 1}, {0, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}, {1, 1, 1}};
/* ways from corner to corner that fill a cell with tetrahedra (Kuhn), the odd ones turned over */
static const unsigned char BLOCK_WAYS[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                               {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
static const unsigned char BLOCK_TET_EDGES[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};

static inline size_t block_grid(const struct block *block, const size_t at[3])
{
    return (at[2] * (2 * block->cells[1] + 1) + at[1]) * (2 * block->cells[0] + 1) + at[0];
}

static inline size_t block_node_count(enum element_type type)
{
    return type == ELEMENT_TET10 ? 10 : type == ELEMENT_HEX20 ? 20 : 27;
}

/* grid points of the nodes of one element of a cell */
static inline void block_element(const struct block *block, const size_t cell[3], int which,
                                 size_t *grid)
{
    size_t corners[4][3];
    if (block->type != ELEMENT_TET10) {
        for (size_t i = 0; i < block_node_count(block->type); i++) {
            size_t at[3];
            for (int k = 0; k < 3; k++)
                at[k] = 2 * cell[k] + BLOCK_HEX[i][k];
            grid[i] = block_grid(block, at);
        }
        return;
    }
    for (int k = 0; k < 3; k++)
        corners[0][k] = 2 * cell[k];
    for (int i = 0; i < 3; i++) {
        memcpy(corners[i + 1], corners[i], sizeof corners[i]);
        corners[i + 1][BLOCK_WAYS[which][i]] += 2;
    }
    if (which >= 3) {
        size_t other[3];
        memcpy(other, corners[1], sizeof other);
        memcpy(corners[1], corners[2], sizeof other);
        memcpy(corners[2], other, sizeof other);
    }
    for (int i = 0; i < 4; i++)
        grid[i] = block_grid(block, corners[i]);
    for (int i = 0; i < 6; i++) {
        size_t at[3];
        for (int k = 0; k < 3; k++)
            at[k] = (corners[BLOCK_TET_EDGES[i][0]][k] + corners[BLOCK_TET_EDGES[i][1]][k]) / 2;
        grid[4 + i] = block_grid(block, at);
    }
}

static inline void block_straighten(struct solid_mesh *mesh)
{
    /* edges of a hexahedron from the doubled coordinates of its mid nodes */
    for (size_t e = 0; e < mesh->element_count; e++) {
        size_t *nodes = mesh->nodes + mesh->first[e];
        bool tet = mesh->types[e] == ELEMENT_TET10;
        for (size_t i = tet ? 4 : 8; i < mesh->first[e + 1] - mesh->first[e]; i++) {
            double sum[3] = {0}, count = 0.0;
            for (size_t c = 0; c < (tet ? 4u : 8u); c++) {
                bool member = true;
                for (int k = 0; k < 3 && !tet; k++)
                    member = member && (BLOCK_HEX[i][k] == 1 || BLOCK_HEX[i][k] == BLOCK_HEX[c][k]);
                if (tet)
                    member = BLOCK_TET_EDGES[i - 4][0] == c || BLOCK_TET_EDGES[i - 4][1] == c;
                for (int k = 0; k < 3 && member; k++)
                    sum[k] += mesh->points[nodes[c]][k];
                count += member;
            }
            for (int k = 0; k < 3; k++)
                mesh->points[nodes[i]][k] = sum[k] / count;
        }
    }
}

/* Free it with solid_mesh_free. One part without a material, "block"; no sets; labels from 1. */
static inline struct solid_mesh block_make(const struct block *block)
{
    const size_t *n = block->cells;
    size_t per_cell = block->type == ELEMENT_TET10 ? 6 : 1;
    size_t nodes = block_node_count(block->type);
    size_t grid_count = (2 * n[0] + 1) * (2 * n[1] + 1) * (2 * n[2] + 1);
    struct solid_mesh mesh = {.unit = 1.0, .element_count = n[0] * n[1] * n[2] * per_cell};
    mesh.types = malloc(mesh.element_count);
    mesh.first = malloc((mesh.element_count + 1) * sizeof *mesh.first);
    mesh.nodes = malloc(mesh.element_count * nodes * sizeof *mesh.nodes);
    mesh.parts = calloc(mesh.element_count, sizeof *mesh.parts);
    mesh.element_labels = malloc(mesh.element_count * sizeof *mesh.element_labels);
    mesh.points = malloc(grid_count * sizeof *mesh.points);
    mesh.labels = malloc(grid_count * sizeof *mesh.labels);
    mesh.part_count = 1;
    mesh.part = calloc(1, sizeof *mesh.part);
    strcpy(mesh.part[0].name, "block");

    /* elements, and which points of the grid they use */
    bool *used = calloc(grid_count, sizeof *used);
    size_t e = 0;
    for (size_t cell = 0; cell < n[0] * n[1] * n[2]; cell++)
        for (size_t k = 0; k < per_cell; k++, e++) {
            size_t at[3] = {cell % n[0], cell / n[0] % n[1], cell / (n[0] * n[1])};
            mesh.types[e] = (unsigned char)block->type;
            mesh.first[e] = e * nodes;
            mesh.element_labels[e] = e + 1;
            block_element(block, at, (int)k, mesh.nodes + e * nodes);
            for (size_t i = 0; i < nodes; i++)
                used[mesh.nodes[e * nodes + i]] = true;
        }
    mesh.first[e] = e * nodes;

    /* their places and numbers */
    size_t *number = malloc(grid_count * sizeof *number);
    for (size_t i = 0; i < grid_count; i++) {
        number[i] = mesh.node_count;
        if (!used[i])
            continue;
        size_t wide = 2 * n[0] + 1, deep = 2 * n[1] + 1;
        double cube[3] = {(double)(i % wide) / (double)(2 * n[0]),
                          (double)(i / wide % deep) / (double)(2 * n[1]),
                          (double)(i / (wide * deep)) / (double)(2 * n[2])};
        block->map(cube, mesh.points[mesh.node_count]);
        mesh.labels[mesh.node_count] = mesh.node_count + 1;
        mesh.node_count++;
    }
    for (size_t i = 0; i < mesh.element_count * nodes; i++)
        mesh.nodes[i] = number[mesh.nodes[i]];
    free(used);
    free(number);
    if (block->straight)
        block_straighten(&mesh);
    return mesh;
}

#endif
