/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/dynamics.h"

#include <math.h>
#include <string.h>

/* Levels: the step of each element, and the order of the nodes by level. */

/* elements between a level and the next but one */
enum { BAND = 3 };

static void finest_around(const struct dynamics *dynamics, const uint8_t *element,
                          uint8_t *node_level)
{
    memset(node_level, DYNAMICS_LEVELS - 1, dynamics->nodes);
    for (size_t e = 0; e < dynamics->elements; e++)
        for (int a = 0; a < QUAD_NODES; a++) {
            uint8_t *level = &node_level[dynamics->quads[e][a]];
            *level = element[e] < *level ? element[e] : *level;
        }
}

/* One pass outward: no element more than one level above any element within BAND of it. */
static bool limit_jumps(struct dynamics *dynamics, uint8_t *reach, uint8_t *node_level)
{
    memcpy(reach, dynamics->element_level, dynamics->elements);
    for (int pass = 0; pass < BAND; pass++) {
        finest_around(dynamics, reach, node_level);
        for (size_t e = 0; e < dynamics->elements; e++)
            for (int a = 0; a < QUAD_NODES; a++) {
                uint8_t level = node_level[dynamics->quads[e][a]];
                reach[e] = level < reach[e] ? level : reach[e];
            }
    }
    bool changed = false;
    for (size_t e = 0; e < dynamics->elements; e++)
        if (dynamics->element_level[e] > reach[e] + 1) {
            dynamics->element_level[e] = reach[e] + 1;
            changed = true;
        }
    return changed;
}

/* elements of the contact nodes take the smallest step */
static void refine_contact(struct dynamics *dynamics, uint8_t *node_level)
{
    finest_around(dynamics, dynamics->element_level, node_level);
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        const struct dynamics_body *body = &dynamics->body[b];
        for (size_t i = 0; i < body->fine; i++)
            node_level[dynamics->number[b][body->mesh->contact.index[i]]] = 0;
    }
    for (size_t e = 0; e < dynamics->elements; e++)
        for (int a = 0; a < QUAD_NODES; a++)
            if (node_level[dynamics->quads[e][a]] == 0)
                dynamics->element_level[e] = 0;
}

/* Sets element_level, levels and step from the longest step of each element; `node_level` (by
 * node, quads in the same numbering) becomes the finest level around it; `scratch` holds one byte
 * an element. Between a level and the next but one lie bands of elements that waves too fast for
 * the coarser one cannot cross. */
static void dynamics_levels_assign(struct dynamics *dynamics, const double *longest,
                                   uint8_t *node_level, uint8_t *scratch)
{
    /* an element of level k takes steps of 2^k times the shortest */
    double shortest = INFINITY;
    for (size_t e = 0; e < dynamics->elements; e++)
        shortest = fmin(shortest, longest[e]);
    dynamics->step = shortest;
    for (size_t e = 0; e < dynamics->elements; e++) {
        int exponent;
        frexp(longest[e] / shortest, &exponent); /* ratio in [2^(exponent - 1), 2^exponent) */
        int level = exponent - 1;
        dynamics->element_level[e] =
            (uint8_t)(level < DYNAMICS_LEVELS - 1 ? level : DYNAMICS_LEVELS - 1);
    }
    /* the contact takes the shortest, and levels rise one by one from there */
    refine_contact(dynamics, node_level);
    while (limit_jumps(dynamics, scratch, node_level))
        ;
    /* a node is moved with the finest of its elements */
    finest_around(dynamics, dynamics->element_level, node_level);
    /* how many levels there are */
    for (size_t e = 0; e < dynamics->elements; e++)
        if (dynamics->element_level[e] >= dynamics->levels)
            dynamics->levels = dynamics->element_level[e] + 1u;
}

/* Renumbers nodes by level, those of the axis first; `order` holds `nodes` numbers. */
static void dynamics_levels_sort(struct dynamics *dynamics, const uint8_t *node_level,
                                 uint32_t *order)
{
    uint32_t next = 0;
    for (unsigned k = 0; k < dynamics->levels; k++) {
        struct dynamics_level *level = &dynamics->level[k];
        level->first = next;
        for (int beside = 0; beside < 2; beside++) {
            for (size_t i = 0; i < dynamics->nodes; i++)
                if (node_level[i] == k && (dynamics->at[i][0] > 0.0) == beside)
                    order[i] = next++;
            if (beside == 0)
                level->axis = next;
        }
        level->last = next;
    }
}

/* Elements of a level in blocks of four, with a history or without. */

/* 0 or 1: the body an element belongs to. */
static inline size_t dynamics_body_of(const struct dynamics *dynamics, size_t element)
{
    return element >= dynamics->first_element[1];
}

/* an element gets a history when its stress reaches this part of the yield stress, so that it
 * cannot come to yield before it is checked again */
static const double NEAR_YIELD = 0.6;

/* False: degenerate. */
static bool dynamics_quad(const struct dynamics *dynamics, size_t element, struct quad *quad)
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
    /* its nodes; their displacements are divided by the root of the mass */
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

/* Packs level k, nothing with a history yet. False: out of memory. */
static bool dynamics_blocks_make(struct dynamics *dynamics, unsigned k)
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
    block->rate = dynamics->body[body].rate;
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

/* Creation. */

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
        const struct material *material = &dynamics->body[dynamics_body_of(dynamics, e)].material;
        if (!dynamics_quad(dynamics, e, &quad))
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
    /* volumes of the elements, shared out to their nodes */
    for (size_t e = 0; e < dynamics->elements; e++) {
        struct quad quad;
        double share[QUAD_NODES];
        dynamics_quad(dynamics, e, &quad);
        quad_shares(&quad, share);
        for (int a = 0; a < QUAD_NODES; a++)
            dynamics->root_mass[dynamics->quads[e][a]] += share[a];
    }
    /* with the density that gives each body its mass */
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

enum percuss_status dynamics_create(const struct dynamics_body body[DYNAMICS_BODIES], double safety,
                                    struct arena *arena, struct dynamics *dynamics,
                                    struct fault *fault)
{
    *dynamics = (struct dynamics){.arena = arena};
    /* both bodies' nodes and elements in one list */
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        dynamics->body[b] = body[b];
        dynamics->nodes += body[b].mesh->nodes;
        dynamics->elements += body[b].mesh->elements;
        dynamics->first_element[b + 1] = dynamics->elements;
    }
    /* room */
    bool ok = allocate(dynamics);
    double *longest = take(dynamics, dynamics->elements, sizeof *longest, &ok);
    uint8_t *node_level = take(dynamics, dynamics->nodes, 1, &ok);
    uint8_t *scratch = take(dynamics, dynamics->elements, 1, &ok);
    uint32_t *order = take(dynamics, dynamics->nodes, sizeof *order, &ok);
    if (!ok)
        return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu nodes", dynamics->nodes);
    /* each element's longest step, and the level of steps that goes with it */
    copy_meshes(dynamics, NULL);
    enum percuss_status status = measure(dynamics, safety, longest, fault);
    if (status != PERCUSS_OK)
        return status;
    dynamics_levels_assign(dynamics, longest, node_level, scratch);
    /* nodes in the order of their levels, so that each level's lie together */
    dynamics_levels_sort(dynamics, node_level, order);
    copy_meshes(dynamics, order);
    weigh(dynamics);
    /* elements four by four */
    for (unsigned k = 0; k < dynamics->levels; k++)
        if (!dynamics_blocks_make(dynamics, k))
            return fault_set(fault, PERCUSS_INTERNAL, "no memory for %zu elements",
                             dynamics->elements);
    return PERCUSS_OK;
}

static void kick_level(struct dynamics *dynamics, unsigned k)
{
    const struct dynamics_level *level = &dynamics->level[k];
    double step = ldexp(dynamics->step, (int)k);
    elastic_blocks_kick(level->elastic, level->elastics, dynamics->y, dynamics->v, step);
    plastic_blocks_kick(level->plastic, level->plastics, dynamics->y, dynamics->v, step);
}

void dynamics_kick(struct dynamics *dynamics, size_t n)
{
    for (unsigned k = 0; k < dynamics->levels && n % ((size_t)1 << k) == 0; k++)
        kick_level(dynamics, k);
}

void dynamics_drift(struct dynamics *dynamics, size_t n)
{
    double *y = dynamics->y;
    double *v = dynamics->v;
    for (unsigned k = 0; k < dynamics->levels && (n + 1) % ((size_t)1 << k) == 0; k++) {
        const struct dynamics_level *level = &dynamics->level[k];
        double step = ldexp(dynamics->step, (int)k);
        for (size_t i = level->first; i < level->axis; i++)
            v[2 * i] = 0.0; /* the axis is a symmetry line */
        for (size_t i = 2 * level->first; i < 2 * level->last; i++)
            y[i] += step * v[i];
    }
}

void dynamics_launch(struct dynamics *dynamics, size_t body, double velocity)
{
    for (size_t i = 0; i < dynamics->body[body].mesh->nodes; i++) {
        uint32_t node = dynamics->number[body][i];
        dynamics->v[2 * node + 1] = dynamics->root_mass[node] * velocity;
    }
}

double dynamics_mean(const struct dynamics *dynamics, size_t body, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < dynamics->body[body].mesh->nodes; i++) {
        uint32_t node = dynamics->number[body][i];
        sum += dynamics->root_mass[node] * x[2 * node + 1];
    }
    return sum / dynamics->mass[body];
}

static void add_strain_energy(const struct dynamics *dynamics, const struct dynamics_level *level,
                              struct dynamics_energy *energy)
{
    for (size_t i = 0; i < level->elastics; i++) {
        const struct elastic_block *block = &level->elastic[i];
        double strain[FE_LANES];
        elastic_block_energy(block, dynamics->y, strain);
        for (int lane = 0; lane < FE_LANES; lane++)
            if (block->element[lane] != UINT32_MAX)
                energy->strain[block->element[lane] >= dynamics->first_element[1]] += strain[lane];
    }
    for (size_t i = 0; i < level->plastics; i++) {
        /* blocks with a history hold elements of one body */
        const struct plastic_block *block = &level->plastic[i];
        size_t body = block->element[0] >= dynamics->first_element[1];
        plastic_block_energy(block, dynamics->y, &energy->strain[body], &energy->plastic[body]);
    }
}

struct dynamics_energy dynamics_energy(const struct dynamics *dynamics, const double *v_before)
{
    struct dynamics_energy energy = {0};
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        /* of the nodes: v is known half a step either side, and holds the root of their mass */
        for (size_t i = 0; i < dynamics->body[b].mesh->nodes; i++) {
            uint32_t node = dynamics->number[b][i];
            bool on_axis = dynamics->at[node][0] == 0.0;
            for (int c = on_axis; c < 2; c++) {
                double v = 0.5 * (dynamics->v[2 * node + c] + v_before[2 * node + c]);
                energy.kinetic[b] += 0.5 * v * v;
            }
        }
        /* of vibration: less that of the mean motion */
        double mean =
            0.5 * (dynamics_mean(dynamics, b, dynamics->v) + dynamics_mean(dynamics, b, v_before));
        energy.vibration[b] = energy.kinetic[b] - 0.5 * dynamics->mass[b] * mean * mean;
    }
    /* of strain and of plastic flow */
    for (unsigned k = 0; k < dynamics->levels; k++)
        add_strain_energy(dynamics, &dynamics->level[k], &energy);
    return energy;
}
