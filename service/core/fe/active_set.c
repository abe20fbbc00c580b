/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/active_set.h"

#include <math.h>
#include <string.h>

#include "numeric/linear.h"

/* forces of the active nodes at an indentation and per metre of it, both at once:
 * compliance f = indentation - initial */
static bool solve_active(struct active_set *set, size_t active, double *constant, double *slope)
{
    double *matrix = set->scratch;
    size_t row = 0;
    for (int pass = 0; pass < 2; pass++) {
        double *right = pass ? slope : constant;
        /* active rows and columns, anew for each solution, which overwrites them */
        row = 0;
        for (size_t i = 0; i < set->count; i++) {
            if (!set->active[i])
                continue;
            size_t column = 0;
            for (size_t j = 0; j < set->count; j++)
                if (set->active[j])
                    matrix[row * active + column++] = set->compliance[i * set->count + j];
            right[row++] = pass ? 1.0 : -set->initial[i];
        }
        if (!linear_solve(active, matrix, right))
            return false;
    }
    return true;
}

/* forces, indentation or total from the present set */
static bool evaluate(struct active_set *set)
{
    /* open nodes carry no force */
    size_t active = 0;
    for (size_t i = 0; i < set->count; i++) {
        set->force[i] = 0.0;
        active += set->active[i];
    }
    /* forces of the active ones, as a constant and a slope by the indentation */
    double *constant = set->scratch + set->count * set->count;
    double *slope = constant + set->count;
    set->stiffness = 0.0;
    if (set->kind == ACTIVE_SET_BY_INDENTATION)
        set->total = 0.0;
    if (active == 0)
        return set->kind == ACTIVE_SET_BY_INDENTATION;
    if (!solve_active(set, active, constant, slope))
        return false;
    /* the total is linear in the indentation; the prescribed quantity fixes the point on the
     * line */
    double at_zero = 0.0;
    for (size_t k = 0; k < active; k++) {
        at_zero += constant[k];
        set->stiffness += slope[k];
    }
    if (set->kind == ACTIVE_SET_BY_TOTAL)
        set->indentation = (set->total - at_zero) / set->stiffness;
    if (set->kind == ACTIVE_SET_BY_EDGE)
        set->indentation = -constant[active - 1] / slope[active - 1];
    if (set->kind != ACTIVE_SET_BY_TOTAL)
        set->total = at_zero + set->stiffness * set->indentation;
    /* each node's force there */
    size_t k = 0;
    for (size_t i = 0; i < set->count; i++)
        if (set->active[i]) {
            set->force[i] = constant[k] + slope[k] * set->indentation;
            k++;
        }
    return true;
}

static double gap(const struct active_set *set, size_t i)
{
    double sum = set->initial[i] - set->indentation;
    for (size_t j = 0; j < set->count; j++)
        sum += set->compliance[i * set->count + j] * set->force[j];
    return sum;
}

/* Turns every node that pulls or overlaps (or, cautiously, the worst alone). Returns how many. */
static size_t turn(struct active_set *set, bool cautiously)
{
    size_t turned = 0, worst = 0;
    double most = 0.0;
    for (size_t i = 0; i < set->count; i++) {
        /* both as lengths: a force times its own compliance */
        double wrong =
            set->active[i] ? -set->force[i] * set->compliance[i * set->count + i] : -gap(set, i);
        double scale = fabs(set->indentation) + fabs(set->initial[i]);
        if (!(wrong > 1e-13 * scale))
            continue;
        turned++;
        if (wrong > most) {
            most = wrong;
            worst = i;
        }
        if (!cautiously)
            set->active[i] = !set->active[i];
    }
    /* the worst alone */
    if (cautiously && turned)
        set->active[worst] = !set->active[worst];
    return turned;
}

bool active_set_solve(struct active_set *set)
{
    /* an edge says which nodes touch */
    if (set->kind == ACTIVE_SET_BY_EDGE) {
        for (size_t i = 0; i < set->count; i++)
            set->active[i] = i <= set->edge;
        return evaluate(set);
    }
    /* a total needs a node that carries it */
    if (set->kind == ACTIVE_SET_BY_TOTAL) {
        bool any = false;
        for (size_t i = 0; i < set->count; i++)
            any |= set->active[i];
        set->active[0] |= !any;
    }
    /* turning all at once settles in a few turns; if it cycles, turning one at a time does not */
    for (size_t turns = 0; turns < 30 + 4 * set->count; turns++) {
        if (!evaluate(set))
            return false;
        if (turn(set, turns >= 30) == 0)
            return true;
    }
    return false;
}
