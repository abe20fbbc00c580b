/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/concurrent.h"

#include <math.h>
#include <stdio.h>

#include "contact/law_closed_form.h"
#include "impact/concurrent.h"
#include "solve/contact_model.h"

/* Elements along the core of the region's mesh, and the fewest steps of a contact over them: both
 * errors halve together from one to the next. */
static const size_t resolutions[] = {6, 12, 24};
enum { RESOLUTIONS = sizeof resolutions / sizeof *resolutions, STEPS = 8 };

/* Of every mesh against the one before: four times the elements, twice the steps, and a little. */
static const double COST = 9.0;
/* Defect of the energy that is allowed, in tolerances. */
static const double CLOSURE = 10.0;
/* Room above the indentation of the closed form: the mesh costs little more for it. */
static const double ROOM = 2.0;

/* Largest indentation of a region over its radius, see region.h. */
static const double INDENTATION_LIMIT = 0.0199;

static enum percuss_status check(const struct problem *problem, struct fault *fault)
{
    const struct solve_options *options = &problem->request->options;
    /* one contact, without a dent */
    if (problem->contact_count != 1)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: concurrent-fe: %zu contacts: it answers one",
                         problem->contact_count);
    if (problem->contact_model.choices[0].dented || problem->contact_model.depth[0] > 0.0)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "bodies[].state: concurrent-fe: there is a dent at contacts[0]: its region "
            "starts without: options.dents must be ignore");
    /* no choice that it has not */
    if (options->method != PERCUSS_METHOD_MODAL)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.method: %s: concurrent-fe is modal: leave it out",
                         method_name(options->method));
    if (options->conditioning)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.conditioning: must be false for concurrent-fe");
    return PERCUSS_OK;
}

/* What all meshes share. */
struct refinement {
    const struct problem *problem;
    const struct scene *scene;
    struct concurrent_settings settings;
    double expected; /* m, largest indentation */
    struct concurrent_effort *effort;
    struct fault *fault;
};

static enum percuss_status solve_on(const struct refinement *refinement, size_t resolution,
                                    struct impact_outcome *outcome)
{
    /* a region that is deep enough for what is expected, and steps as fine as its mesh */
    const struct problem *problem = refinement->problem;
    struct concurrent_settings settings = refinement->settings;
    struct region_input input = {
        .materials = {*problem_material(problem, 0, 0), *problem_material(problem, 0, 1)},
        .radius = closed_form_radius(&problem->hertz[0]),
        .resolution = resolution,
    };
    input.indentation = fmax(refinement->expected,
                             fmin(ROOM * refinement->expected, INDENTATION_LIMIT * input.radius));
    settings.steps = STEPS * (unsigned)resolution;
    /* a fresh region, without dents */
    struct region *region;
    enum percuss_status status = region_create(&input, &region, refinement->fault);
    if (status != PERCUSS_OK)
        return status;
    /* the impact with it, and what that took */
    status = impact_create(outcome, refinement->scene, refinement->problem->arena)
                 ? impact_concurrent(refinement->scene, region, &settings,
                                     refinement->problem->arena, outcome, refinement->fault)
                 : fault_set(refinement->fault, PERCUSS_INTERNAL, "out of memory");
    *refinement->effort = (struct concurrent_effort){resolution, region_effort(region).newton_steps,
                                                     outcome->steps, NAN};
    region_destroy(region);
    return status;
}

/* Errors of the finer one of two solutions: of first order where material flows (backward Euler
 * steps, nodes that touch one by one), so that as much is left as has just changed. */
static void estimate(struct solution *solution, const struct problem *problem,
                     const struct impact_outcome *coarse)
{
    const struct impact_outcome *fine = &solution->outcome;
    double difference =
        fabs(outcome_restitution(problem, fine, 0) - outcome_restitution(problem, coarse, 0));
    solution->steps = (struct step_error){
        .restitution = difference,
        .impulse = difference * problem->impulse_compression[0],
        .energy_defect = outcome_energy_defect(problem, fine),
    };
    solution->steps.energy_closes = solution->steps.energy_defect <= CLOSURE * problem->tolerance;
    solution->tolerance_met =
        solution->steps.energy_closes &&
        solution->steps.restitution + solution->modes.restitution <= problem->tolerance;
}

enum percuss_status concurrent_refine(struct solution *solution, const struct problem *problem,
                                      struct pace *pace, struct concurrent_effort *effort,
                                      struct fault *fault)
{
    enum percuss_status status = check(problem, fault);
    if (status != PERCUSS_OK)
        return status;
    const struct scene *scene = &solution->assembly->scene;
    struct refinement refinement = {
        .problem = problem,
        .scene = scene,
        .settings = {.horizon = attempt_horizon(problem, scene), .pace = pace},
        .effort = effort,
        .fault = fault,
    };
    *effort = (struct concurrent_effort){.extrapolated = NAN};
    /* nothing to refine where they do not touch */
    if (solution->outcome.tracks[0].count == 0)
        return PERCUSS_OK;
    /* finer regions until two agree */
    refinement.expected = outcome_deepest(&solution->outcome, 0);
    solution->tolerance_met = false;
    for (size_t i = 0; i < RESOLUTIONS && !solution->tolerance_met; i++) {
        struct impact_outcome coarse = solution->outcome;
        refinement.settings.done = i ? pow(COST, (double)i - RESOLUTIONS) : 0.0;
        status = solve_on(&refinement, resolutions[i], &solution->outcome);
        if (status != PERCUSS_OK)
            return status;
        /* what the modal solutions say is of another contact model */
        nearby_begin(&solution->nearby, problem, &solution->outcome);
        if (i == 0)
            continue;
        nearby_add(&solution->nearby, problem, &coarse);
        estimate(solution, problem, &coarse);
        /* Richardson, first order, twice as fine: the limit is as far again */
        effort->extrapolated = 2.0 * outcome_restitution(problem, &solution->outcome, 0) -
                               outcome_restitution(problem, &coarse, 0);
    }
    return PERCUSS_OK;
}

void concurrent_report(const struct concurrent_effort *effort, const struct problem *problem,
                       const struct solution *solution, struct solve_result *result)
{
    const struct contact_history *history = &solution->outcome.laws[0].history;
    result->contact_model = PERCUSS_CONTACT_CONCURRENT_FE;
    snprintf(result->reason, sizeof result->reason,
             "contact region of finite elements, solved at each of %lu steps: %zu elements along "
             "its core, %zu Newton steps, dent %.3g um, extrapolated restitution %.5f; %zu modes "
             "up to %.4g Hz, residual flexibility for the others%s",
             effort->steps, effort->resolution, effort->newton_steps, 1e6 * history->dent,
             effort->extrapolated, solution->assembly->all_modes,
             solution->assembly->highest / (2.0 * M_PI),
             problem->hertz[0].axis_ratio < HERTZ_CIRCULAR_RATIO
                 ? "; elliptic: by the sphere of equal stiffness, an approximation"
                 : "");
}
