/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/mode_choice.h"

#include <math.h>

#include "base/extremes.h"
#include "contact/hertz.h"
#include "impact/impact_scale.h"
#include "model/damping.h"

/* ---- How many ---- */

/* Modes that are asked for at first, and shapes at a time. */
enum { FIRST_MODES = 32, SHAPES = 8 };
/* No stand-in is faster than sqrt(3) times the first mode that it stands for
 * (modal_remainder_frequency): the square, with rounding. */
static const double FASTEST = 3.001;

/* One row that may excite the family. */
struct demand {
    const struct family_load *load;
    double left;   /* compliance that the modes so far do not hold, m/N */
    double weight; /* effect of omitted inertia on the restitution, N/(m s^2) */
    double delay;  /* effect of omitted viscosity over that of inertia, s */
};

/* With F = k d^(3/2), K = dF/dd and d'^2 = v^2 (1 - (d/d_m)^(5/2)) the integrals of K' F' and of
 * F'^2 over an elastic collision (see track.h) are 1.78 k^2 v d_m and 1.6 k^2 v d_m^2; the
 * compression impulse is v/W. */
static struct demand make_demand(const struct scene *scene, size_t contact, double rate,
                                 const struct family_load *load)
{
    struct impact_scale scale = impact_scale_of(scene, contact, rate);
    double stiffness = scale.force / scale.indentation;
    double w = scene->w[contact * (scene->rows + 1)];
    return (struct demand){.load = load,
                           .weight = HERTZ_SLOW_INERTIA * stiffness * stiffness * w,
                           .delay = HERTZ_SLOW_VISCOSITY * scale.duration};
}

/* The rows that load the family, as if each contact closed like the fastest of all: a body at rest
 * on another hands the impact on. */
static size_t find_demands(const struct problem *problem, const struct scene *scene, size_t body,
                           size_t family, struct demand *demands, double *compliance)
{
    size_t count = 0;
    double rate = 0.0;
    for (size_t c = 0; c < scene->contacts; c++)
        rate = smaller(scene->gap_rate[c], rate);
    for (size_t r = 0; rate < 0.0 && r < scene->rows; r++) {
        const struct family_load *load = problem_load(problem, r, body, family);
        if (!load)
            continue;
        /* a tangent is about as stiff as its contact */
        demands[count] = make_demand(scene, problem_row_contact(problem, r), rate, load);
        compliance[r] = modal_compliance(problem->bodies[body], family, load, load);
        demands[count++].left = compliance[r];
    }
    return count;
}

/* Whether the modes from `first` on matter too little for each contact. */
static bool suffices(const struct body *body, const struct modal_family *modes, size_t first,
                     const struct demand *demands, size_t count, double allowed)
{
    double stand_in = modal_remainder_frequency(body, modes, first);
    double damping = damping_from(body, first, modes->omega[first]);
    for (size_t i = 0; i < count; i++) {
        double inertia = demands[i].left / (stand_in * stand_in);
        double viscosity = damping * demands[i].left / modes->omega[first];
        if (!((inertia + viscosity * demands[i].delay) * demands[i].weight <= allowed))
            return false;
    }
    return true;
}

/* Whether they matter for their inertia alone: most modes are told by that. */
static bool falls_short(const struct modal_family *modes, size_t first,
                        const struct demand *demands, size_t count, double allowed)
{
    double fastest = FASTEST * allowed * modes->omega[first] * modes->omega[first];
    for (size_t i = 0; i < count; i++)
        if (demands[i].left * demands[i].weight > fastest)
            return true;
    return false;
}

/* Shapes of the next modes of a family at the contacts' loads. */
struct shapes {
    const struct body *body;
    size_t loads, first, count;
    double of[SCENE_MOST_ROWS][SHAPES];
};

static void find_shapes(struct shapes *shapes, const struct prepared_family *known, size_t k,
                        const struct demand *demands)
{
    size_t which[SHAPES];
    size_t left = known->modes->count - k;
    shapes->first = k;
    shapes->count = left < SHAPES ? left : SHAPES;
    for (size_t i = 0; i < shapes->count; i++)
        which[i] = k + i;
    for (size_t i = 0; i < shapes->loads; i++)
        participations_get(known->participations, shapes->body, known->modes, which, shapes->count,
                           demands[i].load, shapes->of[i]);
}

/* Of a family of so many modes and no more: all at once: the effects of those from each on are sums
 * from the last back. */
static size_t count_of_few(const struct mode_choice *choice, const struct problem *problem,
                           const struct body *body, const struct prepared_family *all,
                           const struct demand *demands, size_t loads)
{
    const struct modal_family *modes = all->modes;
    size_t most = modes->count < choice->most ? modes->count : choice->most;
    size_t enough = 0;
    double *row = arena_take(problem->arena, modes->count + 1, sizeof *row);
    size_t *which = arena_take(problem->arena, modes->count + 1, sizeof *which);
    if (!row || !which)
        return MODE_CHOICE_MOST + 1;
    for (size_t k = 0; k < modes->count; k++)
        which[k] = k;
    for (size_t i = 0; i < loads; i++) {
        const double *omega = modes->omega;
        double end = omega[modes->count];
        participations_get(all->participations, body, modes, which, modes->count, demands[i].load,
                           row);
        /* those that the family does not have, then back to the last that matters */
        double inertia =
            modal_beyond(body, modes, modes->count, demands[i].load, 0.0) / (end * end);
        size_t k = modes->count;
        double damping = damping_from(body, k, end);
        for (; k > enough; k--) {
            if (k <= body->damping_count || body->damping_peak > 0.0)
                damping = larger(damping, damping_of(body, k - 1, omega[k - 1]));
            double square = omega[k - 1] * omega[k - 1];
            double with = inertia + row[k - 1] * row[k - 1] / (square * square);
            double viscosity = damping * with * omega[k - 1];
            if (!((with + viscosity * demands[i].delay) * demands[i].weight <= choice->allowed))
                break;
            inertia = with;
        }
        enough = k;
    }
    while (enough > 0 && modes->omega[enough - 1] > choice->cut)
        enough--;
    return enough < most ? enough : most;
}

size_t mode_choice_count(const struct mode_choice *choice, const struct problem *problem,
                         const struct scene *scene, size_t body, size_t family, double *compliance)
{
    /* the contacts' demands on the family */
    struct demand demands[SCENE_MOST_ROWS];
    struct shapes shapes;
    const struct body *owner = problem->bodies[body];
    size_t loads = find_demands(problem, scene, body, family, demands, compliance);
    if (modal_family_most(owner, family) <= MODE_CHOICE_MOST) {
        const struct prepared_family *all =
            prepared_family_get(problem->cache, owner, family, MODE_CHOICE_MOST);
        return all ? count_of_few(choice, problem, owner, all, demands, loads)
                   : MODE_CHOICE_MOST + 1;
    }
    /* mode after mode, until the others do not matter */
    shapes.body = owner;
    shapes.loads = loads;
    shapes.first = shapes.count = 0;
    const struct prepared_family *known = NULL;
    const struct modal_family *modes = NULL;
    for (size_t k = 0; k < choice->most; k++) {
        /* asked for in powers of two: outgrown families are remade */
        if (!modes || k >= modes->count) {
            known = prepared_family_get(problem->cache, owner, family, modes ? 2 * k : FIRST_MODES);
            if (!known)
                return MODE_CHOICE_MOST + 1;
            modes = known->modes;
        }
        if (modes->omega[k] > choice->cut ||
            (!falls_short(modes, k, demands, loads, choice->allowed) &&
             suffices(owner, modes, k, demands, loads, choice->allowed)))
            return k;
        /* compliance left to those */
        if (k >= shapes.first + shapes.count)
            find_shapes(&shapes, known, k, demands);
        for (size_t i = 0; i < loads; i++) {
            double shape = shapes.of[i][k - shapes.first];
            demands[i].left -= shape * shape / (modes->omega[k] * modes->omega[k]);
        }
    }
    return choice->most;
}

/* ---- Which of them: shares of the energy ---- */

/* Share of the energy at hand that the omitted modes get at most, in tolerances. A single blow
 * changes by as much over 2 e; three to four sub-impacts amplify that a thousandfold at worst. */
static const double LEFT_OUT = 1e-4;
/* The rest becomes a group of its own where that saves at least so many of the group's modes: its
 * tables are put together anew for every place that leaves out others. */
static const double WORTH = 0.25;

/* Part that slow modes add to the rigid 1/mass that a contact feels, from which on a body is
 * expected to come back: on a rod's end they add a fourth or less, on a beam's middle nearly as
 * much again. */
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
 * the energy v^2/(2 W): a share of at most 4 phi^2/W. The other effects of the mode on the contact
 * are no more: while the mode is slow a velocity phi^2 J beside W J, when it is fast a compliance
 * phi^2/omega^2 beside the contact's, some W times its duration's square. Of n contacts each may
 * spend all energy, and together they push n times as hard. */
static void find_least(const struct problem *problem, size_t modes, double *least)
{
    size_t n = problem_rows(problem);
    double share = LEFT_OUT * problem->tolerance / (4.0 * (double)(n * n * modes));
    for (size_t r = 0; r < n; r++) {
        /* where a mechanism does not move along a tangent, its force is a share of the normal's */
        double w = problem->row_w[r * (n + 1)];
        if (!(w > 0.0))
            w = problem->row_w[problem_row_contact(problem, r) * (n + 1)];
        least[r] = share * w;
    }
}

/* Whether a mode's participations, squared, are no more than that in any row. */
static bool hardly_moves(const struct scene_group *group, size_t rows, size_t k,
                         const double *least)
{
    for (size_t r = 0; r < rows; r++) {
        const double *row = group->participation[r];
        if (row && !(row[k] * row[k] <= least[r]))
            return false;
    }
    return true;
}

/* The group of those that stay, with their rows. */
static bool take_group(const struct problem *problem, const size_t *which, size_t count,
                       const struct prepared_group **source, struct scene_group *group)
{
    *source = prepared_part_get(problem->cache, *source, which, count);
    if (!*source)
        return false;
    group->set = (*source)->set;
    group->count = count;
    group->stride = group->set->stride;
    for (size_t r = 0; r < problem_rows(problem); r++) {
        const double *all = group->participation[r];
        if (!all)
            continue;
        double *row = arena_take(problem->arena, group->stride + 1, sizeof *row);
        if (!row)
            return false;
        for (size_t i = 0; i < count; i++)
            row[i] = all[which[i]];
        group->participation[r] = row;
    }
    return true;
}

bool mode_choice_leave_out(const struct problem *problem, const struct body_state *state,
                           size_t family, const struct prepared_group **source,
                           struct scene_group *group)
{
    double least[SCENE_MOST_ROWS];
    size_t rows = problem_rows(problem);
    find_least(problem, group->count, least);
    /* how many hardly move */
    size_t few = 0;
    for (size_t k = 0; k < group->count; k++)
        few += hardly_moves(group, rows, k, least);
    if ((double)few < WORTH * (double)group->count || few == 0)
        return true;
    /* those that do, or vibrate */
    size_t *which = arena_take(problem->arena, group->count, sizeof *which);
    if (!which)
        return false;
    size_t count = 0;
    for (size_t k = 0; k < group->count; k++)
        if (!hardly_moves(group, rows, k, least) || is_ringing(state, family, (*source)->mode[k]))
            which[count++] = k;
    return count == group->count || take_group(problem, which, count, source, group);
}

/* Slower than the contact, as in impact_scale.c: omega duration < 1. */
bool mode_choice_returns(const struct problem *problem, size_t contact, size_t body, size_t family)
{
    const struct scene rigid = {.contacts = problem->contact_count,
                                .rows = problem->contact_count,
                                .w = problem->w,
                                .laws = problem->contact_model.laws};
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
