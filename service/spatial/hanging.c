/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/hanging.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Weights below this are nodes that the place does not depend on. */
static const double NO_WEIGHT = 1e-14;

/* A place of the surface's 5 x 5 x 5 lattice, in quarters, that is not a node of the brick. */
static bool is_hanging_place(const int quarter[3])
{
    bool outside = false, between = false;
    for (int c = 0; c < 3; c++) {
        outside |= quarter[c] == 0 || quarter[c] == 4;
        between |= quarter[c] % 2 == 1;
    }
    return outside && between;
}

void hanging_point(int p, double at[3])
{
    int found = 0;
    for (int i = 0; i < 125; i++) {
        int quarter[3] = {i % 5, i / 5 % 5, i / 25};
        if (is_hanging_place(quarter) && found++ == p) {
            for (int c = 0; c < 3; c++)
                at[c] = 0.25 * quarter[c];
            return;
        }
    }
}

bool hanging_create(size_t nodes, struct hanging *hanging)
{
    hanging->nodes = nodes;
    hanging->on = calloc(nodes, sizeof *hanging->on);
    return hanging->on != NULL;
}

void hanging_free(struct hanging *hanging)
{
    free(hanging->on);
}

void hanging_add(struct hanging *hanging, size_t node, unsigned level,
                 const size_t nodes[BRICK_NODES], const double at[3])
{
    struct hanging_on *on = &hanging->on[node];
    if (on->count && on->level <= level)
        return;
    double natural[3] = {2.0 * at[0] - 1.0, 2.0 * at[1] - 1.0, 2.0 * at[2] - 1.0};
    double shape[ELEMENT_MOST_NODES], gradient[ELEMENT_MOST_NODES][3];
    element_shapes(ELEMENT_HEX27, natural, shape, gradient);
    on->count = 0;
    on->level = (unsigned char)level;
    for (int n = 0; n < BRICK_NODES; n++) {
        if (fabs(shape[n]) > NO_WEIGHT) {
            on->masters[on->count] = nodes[n];
            on->weights[on->count++] = shape[n];
        }
    }
}

/* what a node hangs on in the end, being itself where it is free, times `share` */
struct gathering {
    const struct hanging *hanging;
    size_t count, room, *masters;
    double *weights;
    bool lacks; /* memory was out, or a node hangs on its like */
};

static void gather_one(struct gathering *gathering, size_t from, size_t node, double share)
{
    /* a master that is there takes more */
    for (size_t i = from; i < gathering->count; i++)
        if (gathering->masters[i] == node) {
            gathering->weights[i] += share;
            return;
        }
    /* room for another; what was had stays good if there is none */
    if (gathering->count == gathering->room) {
        size_t room = gathering->room ? 2 * gathering->room : 1024;
        size_t *masters = realloc(gathering->masters, room * sizeof *masters);
        if (masters)
            gathering->masters = masters;
        double *weights = realloc(gathering->weights, room * sizeof *weights);
        if (weights)
            gathering->weights = weights;
        gathering->lacks |= !masters || !weights;
        if (gathering->lacks)
            return;
        gathering->room = room;
    }
    gathering->masters[gathering->count] = node;
    gathering->weights[gathering->count++] = share;
}

/* a brick's own node hangs on coarser bricks only: the recursion ends with the levels */
static void gather(struct gathering *gathering, size_t from, size_t node, double share)
{
    const struct hanging_on *on = &gathering->hanging->on[node];
    if (on->count == 0)
        gather_one(gathering, from, node, share);
    for (int i = 0; i < on->count; i++) {
        const struct hanging_on *master = &gathering->hanging->on[on->masters[i]];
        gathering->lacks |= master->count && master->level >= on->level;
        if (!gathering->lacks)
            gather(gathering, from, on->masters[i], share * on->weights[i]);
    }
}

bool hanging_resolve(const struct hanging *hanging, size_t **first, size_t **masters,
                     double **weights)
{
    struct gathering gathering = {.hanging = hanging};
    *first = calloc(hanging->nodes + 1, sizeof **first);
    if (!*first)
        return false;
    for (size_t n = 0; n < hanging->nodes; n++) {
        size_t from = gathering.count;
        if (hanging->on[n].count)
            gather(&gathering, from, n, 1.0);
        (*first)[n + 1] = gathering.count;
    }
    *masters = gathering.masters;
    *weights = gathering.weights;
    return !gathering.lacks;
}
