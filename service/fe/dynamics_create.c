/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <string.h>

#include "fe/dynamics.h"
#include "fe/dynamics_levels.h"

/* an element gets a history when its stress reaches this part of the yield stress, so that it
 * cannot come to yield before it is looked at again */
static const double NEAR_YIELD = 0.6;

static size_t body_of(const struct dynamics *dynamics, size_t element)
{
    return element >= dynamics->first_element[1];
}

static bool make_quad(const struct dynamics *dynamics, size_t element, struct quad *quad)
{
    double r[QUAD_NODES], z[QUAD_NODES];
    for (int a = 0; a < QUAD_NODES; a++) {
        uint32_t node = dynamics->quads[element][a];
        r[a] = dynamics->at[node][0];
        z[a] = dynamics->at[node][1];
    }
    return quad_make(r, z, quad);
}

static void *take(struct dynamics *dynamics, size_t count, size_t size, bool *ok)
{
    void *memory = arena_take(dynamics->arena, count, size);
    *ok = *ok && memory;
    return memory;
}

static bool allocate(struct dynamics *dynamics)
{
    bool ok = true;
    size_t nodes = dynamics->nodes;
    dynamics->quads = take(dynamics, dynamics->elements, sizeof *dynamics->quads, &ok);
    dynamics->element_level = take(dynamics, dynamics->elements, 1, &ok);
    dynamics->plastic = take(dynamics, dynamics->elements, sizeof *dynamics->plastic, &ok);
    dynamics->at = take(dynamics, nodes, sizeof *dynamics->at, &ok);
    dynamics->root_mass = take(dynamics, nodes, sizeof(double), &ok);
    dynamics->y = take(dynamics, 2 * (nodes + 1), sizeof(double), &ok);
    dynamics->v = take(dynamics, 2 * (nodes + 1), sizeof(double), &ok);
    for (size_t b = 0; b < DYNAMICS_BODIES; b++)
        dynamics->number[b] =
            take(dynamics, dynamics->body[b].mesh->nodes, sizeof **dynamics->number, &ok);
    return ok;
}

/* Coordinates and elements of both meshes in one numbering, permuted by `order` when given. */
static void copy_meshes(struct dynamics *dynamics, const uint32_t *order)
{
    uint32_t base = 0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        const struct mesh *mesh = dynamics->body[b].mesh;
        for (uint32_t i = 0; i < mesh->nodes; i++) {
            uint32_t node = order ? order[base + i] : base + i;
            dynamics->number[b][i] = node;
            dynamics->at[node][0] = mesh->r[i];
            dynamics->at[node][1] = mesh->z[i];
        }
        for (size_t e = 0; e < mesh->elements; e++)
            for (int a = 0; a < QUAD_NODES; a++)
                dynamics->quads[dynamics->first_element[b] + e][a] =
                    dynamics->number[b][mesh->quads[e][a]];
        base += (uint32_t)mesh->nodes;
    }
}

/* Longest stable step of each element. */
static enum percuss_status measure(struct dynamics *dynamics, double safety, double *longest,
                                   struct fault *fault)
{
    for (size_t e = 0; e < dynamics->elements; e++) {
        struct quad quad;
        const struct material *material = &dynamics->body[body_of(dynamics, e)].material;
        if (!make_quad(dynamics, e, &quad))
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "mesh: element %zu is degenerate; a milder grade is needed", e);
        longest[e] = safety * 2.0 / quad_highest_frequency(&quad, material);
        if (!(longest[e] > 0.0))
            return fault_set(fault, PERCUSS_INTERNAL, "element %zu has no highest frequency", e);
    }
    return PERCUSS_OK;
}

/* Lumped masses, scaled to the mass of the true body. */
static void weigh(struct dynamics *dynamics)
{
    for (size_t e = 0; e < dynamics->elements; e++) {
        struct quad quad;
        double share[QUAD_NODES];
        make_quad(dynamics, e, &quad);
        quad_shares(&quad, share);
        for (int a = 0; a < QUAD_NODES; a++)
            dynamics->root_mass[dynamics->quads[e][a]] += share[a];
    }
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        const struct dynamics_body *body = &dynamics->body[b];
        double volume = 0.0;
        for (size_t i = 0; i < body->mesh->nodes; i++)
            volume += dynamics->root_mass[dynamics->number[b][i]];
        for (size_t i = 0; i < body->mesh->nodes; i++) {
            double *root = &dynamics->root_mass[dynamics->number[b][i]];
            *root = sqrt(*root * body->mass / volume);
            dynamics->mass[b] += *root * *root;
        }
    }
}

/* Fills one lane, or names the empty node in it. */
static void put(const struct dynamics *dynamics, size_t element, struct elastic_block *elastic,
                struct plastic_block *plastic, size_t lane)
{
    struct quad quad;
    double scale[QUAD_NODES];
    const struct material *material = &dynamics->body[body_of(dynamics, element)].material;
    make_quad(dynamics, element, &quad);
    for (int a = 0; a < QUAD_NODES; a++) {
        uint32_t node = dynamics->quads[element][a];
        scale[a] = 1.0 / dynamics->root_mass[node];
        if (elastic)
            elastic->node[a][lane] = node;
        else
            plastic->node[a][lane] = node;
    }
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

/* Packs the elements of a level that have no history. */
static void pack_elastic(struct dynamics *dynamics, unsigned k)
{
    struct dynamics_level *level = &dynamics->level[k];
    size_t count = 0;
    for (size_t e = 0; e < dynamics->elements; e++) {
        if (dynamics->element_level[e] != k || dynamics->plastic[e])
            continue;
        struct elastic_block *block = &level->elastic[count / FE_LANES];
        if (count % FE_LANES == 0) {
            memset(block, 0, sizeof *block);
            clear_lanes(block->node, block->element, dynamics->nodes);
        }
        put(dynamics, e, block, NULL, count++ % FE_LANES);
    }
    level->elastics = (count + FE_LANES - 1) / FE_LANES;
}

/* Room for all elements of a level as elastic, and for those that may yield with a history. */
static bool make_level(struct dynamics *dynamics, unsigned k)
{
    struct dynamics_level *level = &dynamics->level[k];
    size_t yielding = 0;
    for (size_t e = 0; e < dynamics->elements; e++) {
        if (dynamics->element_level[e] != k)
            continue;
        level->elements++;
        yielding += isfinite(dynamics->body[body_of(dynamics, e)].material.yield);
    }
    bool ok = true;
    level->elastic = take(dynamics, level->elements / FE_LANES + 1, sizeof *level->elastic, &ok);
    /* one block of each body may be filled in part */
    level->plastic =
        take(dynamics, yielding / FE_LANES + DYNAMICS_BODIES, sizeof *level->plastic, &ok);
    if (ok)
        pack_elastic(dynamics, k);
    return ok;
}

enum percuss_status dynamics_create(const struct dynamics_body body[DYNAMICS_BODIES], double safety,
                                    struct arena *arena, struct dynamics *dynamics,
                                    struct fault *fault)
{
    *dynamics = (struct dynamics){.arena = arena};
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        dynamics->body[b] = body[b];
        dynamics->nodes += body[b].mesh->nodes;
        dynamics->elements += body[b].mesh->elements;
        dynamics->first_element[b + 1] = dynamics->elements;
    }
    bool ok = allocate(dynamics);
    double *longest = take(dynamics, dynamics->elements, sizeof *longest, &ok);
    uint8_t *node_level = take(dynamics, dynamics->nodes, 1, &ok);
    uint8_t *scratch = take(dynamics, dynamics->elements, 1, &ok);
    uint32_t *order = take(dynamics, dynamics->nodes, sizeof *order, &ok);
    if (!ok)
        return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu nodes", dynamics->nodes);
    copy_meshes(dynamics, NULL);
    enum percuss_status status = measure(dynamics, safety, longest, fault);
    if (status != PERCUSS_OK)
        return status;
    dynamics_levels_assign(dynamics, longest, node_level, scratch);
    dynamics_levels_sort(dynamics, node_level, order);
    copy_meshes(dynamics, order);
    weigh(dynamics);
    for (unsigned k = 0; k < dynamics->levels; k++)
        if (!make_level(dynamics, k))
            return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu elements",
                             dynamics->elements);
    return PERCUSS_OK;
}

/* Marks elements near yield: first by an energy that excludes it, then by their stresses. */
static size_t mark_level(struct dynamics *dynamics, struct dynamics_level *level)
{
    size_t found = 0;
    for (size_t i = 0; i < level->elastics; i++) {
        const struct elastic_block *block = &level->elastic[i];
        double energy[FE_LANES];
        elastic_block_energy(block, dynamics->y, energy);
        for (int lane = 0; lane < FE_LANES; lane++) {
            uint32_t e = block->element[lane];
            if (e == UINT32_MAX || energy[lane] <= NEAR_YIELD * NEAR_YIELD * block->limit[lane])
                continue;
            struct quad quad;
            double u[QUAD_FREEDOMS];
            const struct material *material = &dynamics->body[body_of(dynamics, e)].material;
            make_quad(dynamics, e, &quad);
            for (int d = 0; d < QUAD_FREEDOMS; d++) {
                uint32_t node = dynamics->quads[e][d / 2];
                u[d] = dynamics->y[2 * node + d % 2] / dynamics->root_mass[node];
            }
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
        if (body_of(dynamics, block->element[0]) != body)
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

/* Gives newly marked elements a place with a history, body by body. */
static void append_plastic(struct dynamics *dynamics, struct dynamics_level *level)
{
    for (size_t i = 0; i < level->elastics * FE_LANES; i++) {
        uint32_t e = level->elastic[i / FE_LANES].element[i % FE_LANES];
        if (e == UINT32_MAX || !dynamics->plastic[e])
            continue;
        size_t lane;
        struct plastic_block *block = free_lane(dynamics, level, body_of(dynamics, e), &lane);
        put(dynamics, e, NULL, block, lane);
    }
}

size_t dynamics_watch_yield(struct dynamics *dynamics)
{
    size_t found = 0;
    if (isinf(dynamics->body[0].material.yield) && isinf(dynamics->body[1].material.yield))
        return 0;
    for (unsigned k = 0; k < dynamics->levels; k++) {
        size_t here = mark_level(dynamics, &dynamics->level[k]);
        if (here > 0) {
            append_plastic(dynamics, &dynamics->level[k]);
            pack_elastic(dynamics, k);
        }
        found += here;
    }
    return found;
}
