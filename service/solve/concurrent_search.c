/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/concurrent_search.h"

#include <math.h>

#include "contact/law_closed_form.h"
#include "impact/concurrent.h"
#include "solve/outcome.h"

/* Elements along the core of the coarsest mesh, and fewest steps of a contact to begin with: an
 * elastic one is wrong by 1e-4 with so many. */
enum { COARSEST = 6, FEWEST_STEPS = 48, PHASES = SWING_PHASES / 2 };

/* What steps twice as many may change is this part of the tolerance: about as much is left. */
static const double STEPS_SHARE = 0.2;
/* What steps leave differs from mesh to mesh by less than this part of it: 0.05 was found. */
static const double STEPS_BY_MESH = 0.1;
/* Cost of a mesh over that of one half as fine: four times the elements, and some. */
static const double COST = 6.0;
/* Part of the first change of the means that no third one hides: second order leaves a quarter of a
 * quarter. */
static const double FIRST_CHANGE = 1.0 / 16.0;
/* The solution that answers may be off the limit by this part of the limit's error; if none is, so
 * many more are solved where the swing says that e passes through it. */
static const double OFF_LIMIT = 0.25;
enum { AIMS = 2 };

/* Room above the indentation of the closed form: the mesh costs little more for it. */
static const double ROOM = 2.0;
/* Largest indentation of a region over its radius, see region.h. */
static const double INDENTATION_LIMIT = 0.0199;

size_t concurrent_resolution(unsigned mesh)
{
    return (size_t)COARSEST << mesh;
}

static double restitution(const struct concurrent_search *search,
                          const struct impact_outcome *outcome)
{
    return outcome_restitution(search->problem, outcome, 0);
}

/* One solution, with a fresh region of a mesh at a phase. */
static enum percuss_status solve_on(struct concurrent_search *search, unsigned mesh, double phase,
                                    unsigned doublings, struct impact_outcome *outcome)
{
    /* a region that is deep enough for what is expected */
    const struct problem *problem = search->problem;
    struct concurrent_settings settings = {
        .horizon = search->horizon, .steps = FEWEST_STEPS << doublings, .pace = search->pace};
    struct region_input input = {
        .materials = {*problem_material(problem, 0, 0), *problem_material(problem, 0, 1)},
        .radius = closed_form_radius(&problem->hertz[0]),
        .resolution = concurrent_resolution(mesh),
        .phase = phase,
    };
    input.indentation =
        fmax(search->expected, fmin(ROOM * search->expected, INDENTATION_LIMIT * input.radius));
    settings.done = pow(COST, (double)mesh + fmin(phase, 0.9) - CONCURRENT_MESHES);
    struct region *region;
    enum percuss_status status = region_create(&input, &region, search->fault);
    if (status != PERCUSS_OK)
        return status;
    /* the impact with it, and what that took */
    status = impact_create(outcome, search->scene, problem->arena)
                 ? impact_concurrent(search->scene, region, &settings, problem->arena, outcome,
                                     search->fault)
                 : fault_set(search->fault, PERCUSS_INTERNAL, "out of memory");
    search->solutions++;
    search->newton_steps += region_effort(region).newton_steps;
    region_destroy(region);
    return status;
}

void concurrent_judge_steps(struct concurrent_steps *steps)
{
    /* the last doubling changed as much as is left where material flows: backward Euler steps are
     * of first order; elastic ones of second leave less */
    double finest = steps->restitution[steps->count - 1];
    double change = finest - steps->restitution[steps->count - 2];
    steps->left = finest + 0.5 * change - steps->restitution[steps->chosen];
    steps->error = 0.5 * fabs(change) + STEPS_BY_MESH * fabs(steps->left);
}

/* Doubles the steps on the coarsest mesh until they matter little. What they leave is known from
 * then on, so that all other solutions make do with a quarter of the last. */
static enum percuss_status search_steps(struct concurrent_search *search)
{
    struct concurrent_steps *steps = &search->steps;
    double change = INFINITY;
    while (steps->count < CONCURRENT_DOUBLINGS &&
           fabs(change) > STEPS_SHARE * search->problem->tolerance) {
        struct impact_outcome outcome;
        enum percuss_status status = solve_on(search, 0, 0.0, steps->count, &outcome);
        if (status != PERCUSS_OK)
            return status;
        double e = restitution(search, &outcome);
        if (steps->count > 0)
            change = e - steps->restitution[steps->count - 1];
        steps->restitution[steps->count++] = e;
    }
    steps->chosen = steps->count > 3 ? steps->count - 3 : 0;
    concurrent_judge_steps(steps);
    return PERCUSS_OK;
}

void concurrent_judge_meshes(struct concurrent_search *search)
{
    const struct swing *swing = search->swing;
    const struct swing *finest = &swing[search->meshes - 1];
    search->restitution = finest->mean + search->steps.left;
    search->error = INFINITY;
    if (search->meshes < 2)
        return;
    /* of first order as much is left as has just changed, of higher orders less: its middle */
    double change = finest->mean - finest[-1].mean;
    double bias = 0.5 * fabs(change);
    search->restitution += 0.5 * change;
    /* two means may come close by chance */
    if (search->meshes > 2)
        bias = fmax(bias, FIRST_CHANGE * fabs(swing[1].mean - swing[0].mean));
    bias = fmax(bias, SWING_IN_MEAN * finest->width);
    search->error = bias + finest->jitter + search->steps.error;
}

/* Three phases of the next mesh. */
static enum percuss_status add_mesh(struct concurrent_search *search)
{
    unsigned mesh = search->meshes++;
    struct swing *swing = &search->swing[mesh];
    *swing = (struct swing){.cells = (unsigned)concurrent_resolution(mesh), .phases = PHASES};
    for (unsigned k = 0; k < PHASES; k++) {
        /* the coarsest mesh alone never answers, and its first phase is known by now */
        if (mesh == 0 && k == 0) {
            swing->restitution[0] = search->steps.restitution[search->steps.chosen];
            continue;
        }
        enum percuss_status status =
            solve_on(search, mesh, (double)k / PHASES, search->steps.chosen, &search->latest[k]);
        if (status != PERCUSS_OK)
            return status;
        swing->restitution[k] = restitution(search, &search->latest[k]);
    }
    swing_judge(swing);
    concurrent_judge_meshes(search);
    return PERCUSS_OK;
}

static void answer_with(struct concurrent_search *search, const struct impact_outcome *outcome)
{
    double error = search->error + fabs(restitution(search, outcome) - search->restitution);
    if (!(error < search->answer_error))
        return;
    search->answer = *outcome;
    search->answer_error = error;
}

/* The phase nearest the limit; returns the error of the answer that may be expected of aiming at
 * it, or that of this one. */
static double choose(struct concurrent_search *search, double *phase, struct swing_bracket *bracket)
{
    search->answer_error = INFINITY;
    for (unsigned k = 0; k < PHASES; k++)
        answer_with(search, &search->latest[k]);
    *phase = swing_phase(&search->swing[search->meshes - 1], search->restitution, bracket);
    double aimed = (1.0 + OFF_LIMIT) * search->error;
    return isfinite(*phase) ? fmin(aimed, search->answer_error) : search->answer_error;
}

/* Solves between the two phases around the limit. */
static enum percuss_status aim(struct concurrent_search *search, double phase,
                               struct swing_bracket *bracket, double allowed)
{
    for (int i = 0; i < AIMS && isfinite(phase) && search->answer_error > allowed; i++) {
        struct impact_outcome outcome;
        enum percuss_status status =
            solve_on(search, search->meshes - 1, fmod(phase, 1.0), search->steps.chosen, &outcome);
        if (status != PERCUSS_OK)
            return status;
        answer_with(search, &outcome);
        phase = swing_narrow(bracket, phase, restitution(search, &outcome) - search->restitution);
    }
    return PERCUSS_OK;
}

enum percuss_status concurrent_search(struct concurrent_search *search, double allowed)
{
    struct swing_bracket bracket;
    double phase = NAN;
    double expected = INFINITY;
    /* steps, then meshes until one is expected to answer */
    enum percuss_status status = search_steps(search);
    while (status == PERCUSS_OK && search->meshes < CONCURRENT_MESHES && expected > allowed) {
        status = add_mesh(search);
        if (status == PERCUSS_OK && search->meshes > 1)
            expected = choose(search, &phase, &bracket);
    }
    return status == PERCUSS_OK ? aim(search, phase, &bracket, allowed) : status;
}
