/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/repeat.h"

#include <math.h>
#include <stdlib.h>

#include "solve/accuracy.h"
#include "solve/contact_model.h"
#include "solve/formulation.h"
#include "solve/placement.h"
#include "solve/radiation.h"
#include "solve/validity.h"

struct repeat {
    struct prepared_cache *cache;
    struct arena scene_memory, run_memory;
    struct problem *problem; /* in scene_memory as what follows; NULL: no scene is kept */
    struct scene scene;
    bool
        lasting; /* nothing in it depends on the blow: no body of a contact can yield or radiates */
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
    arena_release(&repeat->scene_memory);
    arena_release(&repeat->run_memory);
    free(repeat);
}

void repeat_forget(struct repeat *repeat, const char *id)
{
    repeat->problem = NULL;
    prepared_cache_forget(repeat->cache, id);
}

static enum percuss_status no_memory(struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
}

static void read_track(const struct problem *problem, const struct impact_outcome *solved,
                       size_t contact, struct repeat_outcome *outcome)
{
    const struct track *track = &solved->tracks[contact];
    bool unsolved = attempt_is_unsolved(problem, solved);
    *outcome = (struct repeat_outcome){
        .restitution = unsolved ? NAN : attempt_restitution(problem, solved, contact),
        .impulse = track->impulse,
        .end_time = track->end_time,
        .sub_impacts = (unsigned)track->count,
        .error = NAN,
    };
    for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++) {
        outcome->peak_force = fmax(outcome->peak_force, track->list[i].peak_force);
        outcome->significant += !track->list[i].negligible;
    }
    bool complete = solved->end_reason == PERCUSS_END_SEPARATED ||
                    solved->end_reason == PERCUSS_END_HANDED_BACK;
    outcome->status = complete ? PERCUSS_OK : PERCUSS_TRUNCATED;
}

/* What the run says, unless it does not keep the energy. */
static enum percuss_status judge(struct repeat *repeat, const struct problem *problem,
                                 const struct impact_outcome *solved, size_t contact,
                                 struct repeat_outcome *outcome, struct fault *fault)
{
    read_track(problem, solved, contact, outcome);
    validity_find(problem, solved, &repeat->warnings);
    outcome->warnings = repeat->warnings.kinds;
    outcome->contact_model = contact_model_used(problem);
    double defect = attempt_energy_defect(problem, solved);
    if (!attempt_keeps_energy(defect) || !isfinite(outcome->impulse))
        outcome->status = fault_set(fault, PERCUSS_INTERNAL,
                                    "energy: a solution gains or loses %.3g of it", defect);
    return outcome->status;
}

enum percuss_status repeat_search(struct repeat *repeat, const struct solve_means *means,
                                  const struct solve_request *request, size_t contact,
                                  struct repeat_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault)
{
    struct pace pace = {.watch = &means->watch};
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    repeat->problem = NULL; /* its prepared bodies may go */
    arena_reset(&repeat->run_memory);
    prepared_cache_use(repeat->cache, means->catalogue->revision);
    struct problem *problem = problem_create(request, repeat->cache, &repeat->run_memory);
    struct accuracy *accuracy = arena_take(&repeat->run_memory, 1, sizeof *accuracy);
    if (!problem || !accuracy)
        return outcome->status = no_memory(fault);
    outcome->status = formulate(problem, means, fault);
    if (!outcome->status)
        outcome->status = accuracy_reach(accuracy, problem, &pace, fault);
    if (outcome->status)
        return outcome->status;
    judge(repeat, problem, &accuracy->outcome, contact, outcome, fault);
    outcome->error = accuracy->steps.restitution + accuracy->modes.restitution;
    if (model) /* rounding must not lose the highest mode */
        *model = (struct repeat_model){accuracy->assembly->highest * (1.0 + 1e-12),
                                       accuracy->step_accuracy};
    return outcome->status;
}

/* The scene of the problem as it is. */
static bool assemble_scene(struct repeat *repeat, const struct problem *problem,
                           const struct repeat_model *model)
{
    struct mode_choice choice = {.cut = model->cut, .allowed = 0.0, .most = MODE_SEARCH_MOST};
    struct assembly *assembly = arena_take(problem->arena, 1, sizeof *assembly);
    return assembly && assemble(assembly, problem, &choice) &&
           assemble_remainder(assembly, problem, &repeat->scene);
}

/* Makes the scene anew; its memory outlives the run. */
static enum percuss_status make_scene(struct repeat *repeat, const struct solve_means *means,
                                      const struct solve_request *request,
                                      const struct repeat_model *model, struct fault *fault)
{
    repeat->problem = NULL;
    prepared_cache_use(repeat->cache, means->catalogue->revision);
    arena_reset(&repeat->scene_memory);
    struct problem *problem = problem_create(request, repeat->cache, &repeat->scene_memory);
    if (!problem)
        return no_memory(fault);
    enum percuss_status status = formulate(problem, means, fault);
    if (status)
        return status;
    if (!assemble_scene(repeat, problem, model))
        return no_memory(fault);
    repeat->lasting = !radiation_is_possible(problem);
    for (size_t c = 0; c < problem->contact_count; c++)
        repeat->lasting = repeat->lasting && problem->contact_model.choices[c].side < 0;
    repeat->problem = problem;
    return PERCUSS_OK;
}

/* Solves the scene, with other laws too if the blow asks for them. */
static enum percuss_status run_scene(struct repeat *repeat, const struct watch *watch,
                                     const struct repeat_model *model, struct attempt *attempt,
                                     struct fault *fault)
{
    struct pace pace = {.watch = watch};
    struct problem *problem = repeat->problem;
    struct attempt_context context = {
        .problem = problem, .arena = &repeat->run_memory, .pace = &pace};
    attempt->accuracy = model->accuracy;
    for (;;) {
        context.work = attempt_work_allowed(problem->request->options.method);
        enum percuss_status status = attempt_run(&context, attempt, &repeat->scene);
        if (status)
            return pace_fault(fault, status);
        if (attempt->outcome.always_overlapped)
            return attempt_refuse_overlap(&context, attempt,
                                          attempt_horizon(problem, &repeat->scene), fault);
        if (!formulation_revise(problem, &repeat->scene, &attempt->outcome))
            return PERCUSS_OK;
        /* what this blow decided is not for the next one */
        repeat->lasting = false;
        if (!assemble_scene(repeat, problem, model))
            return no_memory(fault);
    }
}

enum percuss_status repeat_solve(struct repeat *repeat, const struct solve_means *means,
                                 const struct solve_request *request, size_t contact,
                                 const struct repeat_model *model, bool same_scene,
                                 struct repeat_outcome *outcome, struct fault *fault)
{
    struct attempt attempt = {0};
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    arena_reset(&repeat->run_memory);
    /* the laws of bodies that yield and the waves of half-spaces are chosen by the blow */
    if (same_scene && repeat->problem && repeat->lasting) {
        repeat->problem->request = request;
        outcome->status = placement_find_rates(repeat->problem, fault);
    } else {
        outcome->status = make_scene(repeat, means, request, model, fault);
    }
    if (!outcome->status)
        outcome->status = run_scene(repeat, &means->watch, model, &attempt, fault);
    if (outcome->status)
        return outcome->status;
    return judge(repeat, repeat->problem, &attempt.outcome, contact, outcome, fault);
}

const struct warnings *repeat_warnings(const struct repeat *repeat)
{
    return &repeat->warnings;
}
