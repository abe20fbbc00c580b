/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/concurrent.h"

#include <math.h>
#include <stdio.h>

#include "contact/law_closed_form.h"
#include "solve/concurrent_search.h"
#include "solve/contact_model.h"

/* Defect of the energy that is allowed, in tolerances. */
static const double CLOSURE = 10.0;
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

/* Takes the search's answer, its error, and the solutions near it. */
static void adopt(struct solution *solution, const struct problem *problem,
                  const struct concurrent_search *search)
{
    const struct impact_outcome *answer = &search->answer;
    solution->outcome = *answer;
    solution->log = NULL;
    solution->steps = (struct step_error){
        .restitution = search->answer_error,
        .impulse = search->answer_error * problem->impulse_compression[0],
        .energy_defect = outcome_energy_defect(problem, answer),
    };
    solution->steps.energy_closes =
        outcome_energy_closes(problem, answer, CLOSURE * problem->tolerance);
    solution->tolerance_met =
        solution->steps.energy_closes &&
        solution->steps.restitution + solution->modes.restitution <= problem->tolerance;
    /* what the modal solutions say is of another contact model */
    neighbours_begin(&solution->neighbours, problem, answer);
    for (unsigned k = 0; k < SWING_PHASES / 2; k++)
        neighbours_add(&solution->neighbours, problem, &search->latest[k]);
}

enum percuss_status concurrent_refine(struct solution *solution, const struct problem *problem,
                                      struct pace *pace, struct concurrent_effort *effort,
                                      struct fault *fault)
{
    enum percuss_status status = check(problem, fault);
    if (status != PERCUSS_OK)
        return status;
    *effort = (struct concurrent_effort){.extrapolated = NAN};
    /* nothing to refine where they do not touch */
    if (solution->outcome.tracks[0].count == 0)
        return PERCUSS_OK;
    struct concurrent_search *search = arena_take(problem->arena, 1, sizeof *search);
    if (!search)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    const struct scene *scene = &solution->assembly->scene;
    *search = (struct concurrent_search){
        .problem = problem,
        .scene = scene,
        .pace = pace,
        .fault = fault,
        .horizon = attempt_horizon(problem, scene),
        .expected = outcome_deepest(&solution->outcome, 0),
    };
    /* finer steps and meshes, within what the modes leave of the tolerance */
    status = concurrent_search(search, problem->tolerance - solution->modes.restitution);
    if (status != PERCUSS_OK)
        return status;
    adopt(solution, problem, search);
    *effort = (struct concurrent_effort){
        .resolution = concurrent_resolution(search->meshes - 1),
        .solutions = search->solutions,
        .newton_steps = search->newton_steps,
        .steps = search->answer.steps,
        .extrapolated = search->restitution,
    };
    return PERCUSS_OK;
}

void concurrent_report(const struct concurrent_effort *effort, const struct problem *problem,
                       const struct solution *solution, struct solve_result *result)
{
    const struct contact_history *history = &solution->outcome.laws[0].history;
    result->contact_model = PERCUSS_CONTACT_CONCURRENT_FE;
    snprintf(result->reason, sizeof result->reason,
             "contact region of finite elements, solved at each of %lu steps: %zu elements along "
             "its core; %zu solutions, %zu Newton steps; dent %.3g um, limit of the restitution "
             "%.5f; %zu modes up to %.4g Hz, residual flexibility for the others%s",
             effort->steps, effort->resolution, effort->solutions, effort->newton_steps,
             1e6 * history->dent, effort->extrapolated, solution->assembly->all_modes,
             solution->assembly->highest / (2.0 * M_PI),
             problem->hertz[0].axis_ratio < HERTZ_CIRCULAR_RATIO
                 ? "; elliptic: by the sphere of equal stiffness, an approximation"
                 : "");
}
