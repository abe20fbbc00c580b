/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/dynamics_blocks.h"

#include <math.h>

/* an element gets a history when its stress reaches this part of the yield stress, so that it
 * cannot come to yield before it is looked at again */
static const double NEAR_YIELD = 0.6;

bool dynamics_quad(const struct dynamics *dynamics, size_t element, struct quad *quad)
{
    double r[QUAD_NODES], z[QUAD_NODES];
    for (int a = 0; a < QUAD_NODES; a++) {
        uint32_t node = dynamics->quads[element][a];
        r[a] = dynamics->at[node][0];
        z[a] = dynamics->at[node][1];
    }
    return quad_make(r, z, quad);
}

/* Fills one lane, or names the empty node in it. */
static void put(const struct dynamics *dynamics, size_t element, struct elastic_block *elastic,
                struct plastic_block *plastic, size_t lane)
{
    struct quad quad;
    double scale[QUAD_NODES];
    const struct material *material = &dynamics->body[dynamics_body_of(dynamics, element)].material;
    dynamics_quad(dynamics, element, &quad);
    /* its nodes, by whose root of mass their displacements are divided */
    for (int a = 0; a < QUAD_NODES; a++) {
        uint32_t node = dynamics->quads[element][a];
        scale[a] = 1.0 / dynamics->root_mass[node];
        if (elastic)
            elastic->node[a][lane] = node;
        else
            plastic->node[a][lane] = node;
    }
    /* its stiffness, or its slopes and law */
    if (elastic)
        elastic_block_put(elastic, lane, &quad, material, scale);
    else
        plastic_block_put(plastic, lane, &quad, material, scale);
    *(elastic ? &elastic->element[lane] : &plastic->element[lane]) = (uint32_t)element;
}

static void clear_lanes(uint32_t node[QUAD_NODES][FE_LANES], uint32_t element[FE_LANES],
                        size_t empty)
{
    for (int lane = 0; lane < FE_LANES; lane++) {
        element[lane] = UINT32_MAX;
        for (int a = 0; a < QUAD_NODES; a++)
            node[a][lane] = (uint32_t)empty;
    }
}

/* Room for all elements of a level as elastic, and for those that may yield with a history. */
static bool make_room(struct dynamics *dynamics, unsigned k)
{
    struct dynamics_level *level = &dynamics->level[k];
    size_t yielding = 0;
    for (size_t e = 0; e < dynamics->elements; e++) {
        if (dynamics->element_level[e] != k)
            continue;
        level->elements++;
        yielding += isfinite(dynamics->body[dynamics_body_of(dynamics, e)].material.yield);
    }
    /* the last block of elastic ones, and of each body's others, may be filled in part */
    size_t elastic = level->elements / FE_LANES + 1;
    size_t plastic = yielding / FE_LANES + DYNAMICS_BODIES;
    level->elastic = arena_take(dynamics->arena, elastic, sizeof *level->elastic);
    level->plastic = arena_take(dynamics->arena, plastic, sizeof *level->plastic);
    return level->elastic && level->plastic;
}

bool dynamics_blocks_make(struct dynamics *dynamics, unsigned k)
{
    struct dynamics_level *level = &dynamics->level[k];
    if (!make_room(dynamics, k))
        return false;
    size_t count = 0;
    for (size_t e = 0; e < dynamics->elements; e++) {
        if (dynamics->element_level[e] != k)
            continue;
        struct elastic_block *block = &level->elastic[count / FE_LANES];
        if (count % FE_LANES == 0) {
            clear_lanes(block->node, block->element, dynamics->nodes);
            level->elastics++;
        }
        put(dynamics, e, block, NULL, count++ % FE_LANES);
    }
    return true;
}

/* Marks elements near yield: first by an energy that excludes it, then by their stresses. */
static size_t mark_level(struct dynamics *dynamics, struct dynamics_level *level)
{
    size_t found = 0;
    for (size_t i = 0; i < level->elastics; i++) {
        const struct elastic_block *block = &level->elastic[i];
        double energy[FE_LANES];
        elastic_block_energy(block, dynamics->y, energy);
        /* four elements at once, by the energy of their strains */
        for (int lane = 0; lane < FE_LANES; lane++) {
            uint32_t e = block->element[lane];
            if (e == UINT32_MAX || energy[lane] <= NEAR_YIELD * NEAR_YIELD * block->limit[lane])
                continue;
            /* those that this does not exclude, one by one */
            struct quad quad;
            double u[QUAD_FREEDOMS];
            const struct material *material =
                &dynamics->body[dynamics_body_of(dynamics, e)].material;
            dynamics_quad(dynamics, e, &quad);
            for (int d = 0; d < QUAD_FREEDOMS; d++) {
                uint32_t node = dynamics->quads[e][d / 2];
                u[d] = dynamics->y[2 * node + d % 2] / dynamics->root_mass[node];
            }
            /* near yield: they get a history */
            if (quad_mises(&quad, material, u) < NEAR_YIELD * material->yield)
                continue;
            dynamics->plastic[e] = true;
            found++;
        }
    }
    return found;
}

/* A free lane among the blocks of one body, a new block where there is none. */
static struct plastic_block *free_lane(struct dynamics *dynamics, struct dynamics_level *level,
                                       size_t body, size_t *lane)
{
    for (size_t i = level->plastics; i-- > 0;) {
        struct plastic_block *block = &level->plastic[i];
        if (dynamics_body_of(dynamics, block->element[0]) != body)
            continue;
        for (*lane = 1; *lane < FE_LANES; (*lane)++)
            if (block->element[*lane] == UINT32_MAX)
                return block;
        break; /* only the last block of a body has free lanes */
    }
    struct plastic_block *block = &level->plastic[level->plastics++];
    clear_lanes(block->node, block->element, dynamics->nodes);
    *lane = 0;
    return block;
}

/* The last elastic element of a level fills the lane of one that leaves. */
static void drop_elastic(const struct dynamics *dynamics, struct dynamics_level *level, size_t gone)
{
    struct elastic_block *last = &level->elastic[level->elastics - 1];
    int lane = FE_LANES - 1;
    while (last->element[lane] == UINT32_MAX)
        lane--;
    elastic_block_move(&level->elastic[gone / FE_LANES], gone % FE_LANES, last, (size_t)lane,
                       (uint32_t)dynamics->nodes);
    level->elastics -= lane == 0;
}

/* Gives newly marked elements a place with a history. */
static void move_marked(struct dynamics *dynamics, struct dynamics_level *level)
{
    for (size_t i = level->elastics * FE_LANES; i-- > 0;) {
        uint32_t e = level->elastic[i / FE_LANES].element[i % FE_LANES];
        if (e == UINT32_MAX || !dynamics->plastic[e])
            continue;
        size_t lane;
        struct plastic_block *block =
            free_lane(dynamics, level, dynamics_body_of(dynamics, e), &lane);
        put(dynamics, e, NULL, block, lane);
        drop_elastic(dynamics, level, i);
    }
}

size_t dynamics_watch_yield(struct dynamics *dynamics)
{
    size_t found = 0;
    if (isinf(dynamics->body[0].material.yield) && isinf(dynamics->body[1].material.yield))
        return 0;
    for (unsigned k = 0; k < dynamics->levels; k++) {
        size_t here = mark_level(dynamics, &dynamics->level[k]);
        if (here > 0)
            move_marked(dynamics, &dynamics->level[k]);
        found += here;
    }
    return found;
}
