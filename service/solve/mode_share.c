/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/mode_share.h"

#include "impact/impact_scale.h"

/* Share of the energy at hand that what is left out gets at most, in tolerances. A single blow
 * changes by as much over 2 e; three to four sub-impacts amplify that a thousandfold at worst. */
static const double LEFT_OUT = 1e-4;
/* The rest becomes a group of its own where that saves at least so many of the group's modes: its
 * tables are put together anew for every place that leaves out others. */
static const double WORTH = 0.25;

/* What slow modes add to the rigid 1/mass that a contact feels, from which on a body is expected to
 * come back: on a rod's end they add a fourth or less, on a beam's middle nearly as much again. */
static const double RETURNS = 0.5;
/* Slow modes that are looked at: as many add that much, or the contact is among higher ones. */
enum { LOWEST = 32 };

/* Whether a mode vibrates already. */
static bool is_ringing(const struct body_state *state, size_t family, size_t mode)
{
    if (!state || mode >= state->count[family])
        return false;
    const double *pair = body_state_family(state, family) + 2 * mode;
    return pair[0] != 0.0 || pair[1] != 0.0;
}

/* An elastic collision of a contact has the impulse J <= 2 v/W, which gives a mode phi^2 J^2/2 of
 * the energy v^2/(2 W): a share of at most 4 phi^2/W. What the contact feels of the mode besides is
 * no more: while the mode is slow a velocity phi^2 J beside W J, when it is fast a compliance
 * phi^2/omega^2 beside the contact's, some W times its duration's square. Of n contacts each may
 * spend all energy, and together they push n times as hard. */
static void find_least(const struct problem *problem, size_t modes, double *least)
{
    size_t n = problem->contact_count;
    double share = LEFT_OUT * problem->tolerance / (4.0 * (double)(n * n * modes));
    for (size_t c = 0; c < n; c++)
        least[c] = share * problem->w[c * n + c];
}

/* Whether a mode's participations, squared, are no more than that at any contact. */
static bool hardly_moves(const struct scene_group *group, size_t contacts, size_t k,
                         const double *least)
{
    for (size_t c = 0; c < contacts; c++) {
        const double *row = group->participation[c];
        if (row && !(row[k] * row[k] <= least[c]))
            return false;
    }
    return true;
}

/* The group of those that stay, with their rows. */
static bool keep(const struct problem *problem, const size_t *which, size_t count,
                 const struct prepared_group **source, struct scene_group *group)
{
    *source = prepared_part_get(problem->cache, *source, which, count);
    if (!*source)
        return false;
    group->set = (*source)->set;
    group->count = count;
    group->stride = group->set->stride;
    for (size_t c = 0; c < problem->contact_count; c++) {
        const double *all = group->participation[c];
        if (!all)
            continue;
        double *row = arena_take(problem->arena, group->stride + 1, sizeof *row);
        if (!row)
            return false;
        for (size_t i = 0; i < count; i++)
            row[i] = all[which[i]];
        group->participation[c] = row;
    }
    return true;
}

bool mode_share_leave_out(const struct problem *problem, const struct body_state *state,
                          size_t family, const struct prepared_group **source,
                          struct scene_group *group)
{
    double least[PERCUSS_MAX_CONTACTS];
    find_least(problem, group->count, least);
    /* how many hardly move */
    size_t few = 0;
    for (size_t k = 0; k < group->count; k++)
        few += hardly_moves(group, problem->contact_count, k, least);
    if ((double)few < WORTH * (double)group->count || few == 0)
        return true;
    /* those that do, or vibrate */
    size_t *which = arena_take(problem->arena, group->count, sizeof *which);
    if (!which)
        return false;
    size_t count = 0;
    for (size_t k = 0; k < group->count; k++)
        if (!hardly_moves(group, problem->contact_count, k, least) ||
            is_ringing(state, family, (*source)->mode[k]))
            which[count++] = k;
    return count == group->count || keep(problem, which, count, source, group);
}

/* Slower than the contact, as in impact_scale.c: omega duration < 1. */
bool mode_share_returns(const struct problem *problem, size_t contact, size_t body, size_t family)
{
    const struct scene rigid = {
        .contacts = problem->contact_count, .w = problem->w, .laws = problem->contact_model.laws};
    double w = problem->w[contact * (problem->contact_count + 1)];
    double duration = impact_scale_of(&rigid, contact, problem->gap_rate[contact]).duration;
    const struct prepared_family *known =
        prepared_family_get(problem->cache, problem->bodies[body], family, LOWEST);
    const struct family_load *load = problem_load(problem, contact, body, family);
    if (!known || !load)
        return true;
    /* the lowest of them, as they are in the file */
    size_t which[LOWEST];
    double row[LOWEST];
    size_t count = 0;
    while (count < LOWEST && count < known->modes->count &&
           known->modes->omega[count] * duration < 1.0) {
        which[count] = count;
        count++;
    }
    modal_participations(problem->bodies[body], known->modes, which, count, load, row);
    double sum = 0.0;
    for (size_t k = 0; k < count; k++)
        sum += row[k] * row[k];
    return count == LOWEST || sum > RETURNS * w;
}
