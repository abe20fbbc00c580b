/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/repeat.h"

#include <math.h>
#include <stdlib.h>

#include "solve/contact_model.h"
#include "solve/formulation.h"
#include "solve/radiation.h"
#include "solve/relaxed.h"
#include "solve/validity.h"

struct repeat {
    struct prepared_cache *cache;
    struct arena problem_memory, run_memory;
    struct problem *problem; /* in problem_memory; NULL: none */
    struct solution solution;
    bool lasting;             /* it holds for other velocities, too */
    struct warnings warnings; /* of the last solution */
};

struct repeat *repeat_create(void)
{
    struct repeat *repeat = calloc(1, sizeof *repeat);
    if (!repeat)
        return NULL;
    repeat->cache = prepared_cache_create();
    if (!repeat->cache) {
        free(repeat);
        return NULL;
    }
    return repeat;
}

void repeat_free(struct repeat *repeat)
{
    if (!repeat)
        return;
    prepared_cache_free(repeat->cache);
    arena_release(&repeat->problem_memory);
    arena_release(&repeat->run_memory);
    free(repeat);
}

void repeat_forget(struct repeat *repeat)
{
    repeat->problem = NULL;
}

static void read_track(const struct problem *problem, const struct impact_outcome *solved,
                       size_t contact, struct repeat_outcome *outcome)
{
    const struct track *track = &solved->tracks[contact];
    bool unsolved = outcome_is_unsolved(problem, solved);
    *outcome = (struct repeat_outcome){
        .status = outcome_is_complete(solved) ? PERCUSS_OK : PERCUSS_TRUNCATED,
        .restitution = unsolved ? NAN : outcome_restitution(problem, solved, contact),
        .impulse = track->impulse,
        .end_time = track->end_time,
        .peak_force = outcome_peak_force(solved, contact),
        .sub_impacts = (unsigned)track->count,
        .compression = problem->impulse_compression[contact],
        .tangential_restitution = NAN,
        .error = NAN,
    };
    outcome->restitution_kinematic =
        outcome_kinematic(problem, solved, contact, outcome->restitution);
    for (size_t i = 0; i < problem->friction_count; i++) {
        if (problem->friction[i].contact != contact)
            continue;
        for (size_t t = 0; t < 2; t++)
            outcome->tangential[t] = track->tangential[t];
        outcome->tangential_restitution = outcome_tangential_restitution(problem, solved, i);
    }
    for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++)
        outcome->significant += !track->list[i].negligible;
}

/* Reads the solution; refuses one that does not keep the energy. */
static enum percuss_status repeat_judge(struct repeat *repeat, size_t contact,
                                        struct repeat_outcome *outcome, struct fault *fault)
{
    const struct problem *problem = repeat->problem;
    const struct impact_outcome *solved = &repeat->solution.outcome;
    read_track(problem, solved, contact, outcome);
    validity_find(problem, solved, &repeat->warnings);
    validity_find_waves(problem, repeat->solution.assembly->radiated_error, &repeat->warnings);
    outcome->warnings = repeat->warnings.kinds;
    outcome->contact_model = contact_model_used(problem)->model;
    double defect = outcome_energy_defect(problem, solved);
    if (!outcome_keeps_energy(defect) || !isfinite(outcome->impulse))
        outcome->status = fault_set(fault, PERCUSS_INTERNAL,
                                    "energy: a solution gains or loses %.3g of it", defect);
    return outcome->status;
}

/* Whether another impact of the same bodies is the same problem but for its rates: they decide the
 * laws of bodies that yield, the waves of half-spaces, a sphere's matched compliance, whether a
 * block or cylinder vibrates (vibration.h), and how far materials relax. */
static bool lasts(const struct problem *problem)
{
    bool lasts =
        !radiation_is_possible(problem) && !problem->compliance.by_speed && !relaxed_any(problem);
    for (size_t b = 0; b < problem->body_count; b++)
        lasts = lasts && !(problem->bodies[b]->kind->box && body_can_vibrate(problem->bodies[b]));
    for (size_t c = 0; c < problem->contact_count; c++)
        lasts = lasts && problem->contact_model.choices[c].side < 0 &&
                !problem->contact_model.choices[c].own &&
                !problem->contact_model.laws[c].operations->remembers;
    return lasts;
}

/* Bodies of samples before are of use for their modes alone, of which the last ones' are enough. */
static const size_t MOST_BYTES = (size_t)16 << 20;

static enum percuss_status repeat_begin(struct repeat *repeat, const struct solve_context *context,
                                        const struct solve_request *request, struct fault *fault)
{
    repeat->problem = NULL;
    repeat->solution.scene = NULL;
    if (prepared_cache_bytes(repeat->cache) > MOST_BYTES)
        prepared_cache_drop(repeat->cache, true);
    prepared_cache_use(repeat->cache, context->catalogue->revision);
    arena_reset(&repeat->problem_memory);
    struct problem *problem = problem_create(request, repeat->cache, &repeat->problem_memory);
    if (!problem)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = formulate(problem, context, fault);
    if (status)
        return status;
    repeat->problem = problem;
    repeat->lasting = lasts(problem);
    return PERCUSS_OK;
}

/* Uses the last problem for other velocities. */
static enum percuss_status repeat_go_on(struct repeat *repeat, const struct solve_request *request,
                                        struct fault *fault)
{
    repeat->problem->request = request;
    return placement_find_rates(repeat->problem, fault);
}

/* By a model, or with NULL by a search. */
static enum percuss_status repeat_find(struct repeat *repeat, const struct solve_context *context,
                                       const struct solve_request *request,
                                       const struct solution_model *model, bool same_scene,
                                       struct fault *fault)
{
    /* the last problem, or a new one */
    struct pace pace = {.watch = &context->watch};
    bool reuse = same_scene && repeat->problem && repeat->lasting;
    arena_reset(&repeat->run_memory);
    enum percuss_status status = reuse ? repeat_go_on(repeat, request, fault)
                                       : repeat_begin(repeat, context, request, fault);
    if (!status)
        status = solution_find(&repeat->solution, repeat->problem, repeat->problem->tolerance,
                               model, &repeat->run_memory, &pace, fault);
    /* a revision by this impact does not hold for the next one */
    repeat->lasting = repeat->lasting && !repeat->solution.revised;
    /* a solution that lacked memory is none, whatever its status */
    if (repeat->problem_memory.lacks || repeat->run_memory.lacks) {
        repeat->problem = NULL;
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    }
    return status;
}

enum percuss_status repeat_search(struct repeat *repeat, const struct solve_context *context,
                                  const struct solve_request *request, size_t contact,
                                  struct solution_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault)
{
    const struct solution *solution = &repeat->solution;
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = repeat_find(repeat, context, request, NULL, false, fault);
    if (!outcome->status) {
        repeat_judge(repeat, contact, outcome, fault);
        outcome->error = solution->error.steps.restitution + solution->error.modes.restitution;
        if (model)
            *model = solution_model_of(solution);
    }
    repeat->problem = NULL; /* its scene is not of a model */
    return outcome->status;
}

enum percuss_status repeat_solve(struct repeat *repeat, const struct solve_context *context,
                                 const struct solve_request *request, size_t contact,
                                 const struct solution_model *model, bool same_scene,
                                 struct repeat_outcome *outcome, struct fault *fault)
{
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = repeat_find(repeat, context, request, model, same_scene, fault);
    return outcome->status ? outcome->status : repeat_judge(repeat, contact, outcome, fault);
}

const struct warnings *repeat_warnings(const struct repeat *repeat)
{
    return &repeat->warnings;
}
