/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/dynamics_levels.h"

#include <math.h>
#include <string.h>

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

void dynamics_levels_assign(struct dynamics *dynamics, const double *longest, uint8_t *node_level,
                            uint8_t *scratch)
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

void dynamics_levels_sort(struct dynamics *dynamics, const uint8_t *node_level, uint32_t *order)
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
