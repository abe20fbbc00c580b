/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <string.h>

#include "fe/dynamics.h"
#include "fe/dynamics_blocks.h"
#include "fe/dynamics_levels.h"

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
    /* with the density that makes each body as heavy as it is */
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
