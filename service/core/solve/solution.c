/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/solution.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "solve/error/attempt.h"
#include "solve/error/calibration.h"
#include "solve/formulation.h"
#include "solve/oblique.h"

/* Less of the effort allowed than a step costs at most. */
static const double SPENT = 1e-3;
/* Relative: so that the highest mode is below the cut that it gives. */
static const double ROUNDING = 1e-12;
/* Relative change of the speeds for a derivative, and the accuracy that it needs: the steps' error
 * (error/refinement.c) then changes it by 3e-4 of e over the speed. */
static const double SPEED_STEP = 1e-5;
static const double DERIVATIVE_ACCURACY = 1e-9;

/* d(restitution)/d(speed), and that of the tangential impulse, of the contact with the largest
 * impulse, by central difference with all gap rates scaled. */
static enum percuss_status find_conditioning(struct attempt_context *context,
                                             const struct attempt *best, struct solution *solution)
{
    /* the contact with the largest impulse */
    const struct track *tracks = best->outcome.tracks;
    size_t main_contact = 0;
    for (size_t c = 1; c < context->problem->contact_count; c++)
        if (tracks[c].impulse > tracks[main_contact].impulse)
            main_contact = c;
    /* its restitution and tangential impulse a little slower and a little faster */
    double restitution[2], tangential[2][2];
    for (int side = 0; side < 2; side++) {
        struct attempt shifted = *best;
        shifted.accuracy = smaller(best->accuracy, DERIVATIVE_ACCURACY);
        enum percuss_status status =
            attempt_run_scaled(context, &shifted, side == 0 ? 1.0 - SPEED_STEP : 1.0 + SPEED_STEP);
        if (status || attempt_is_spent(&shifted))
            return status;
        restitution[side] = outcome_restitution(context->problem, &shifted.outcome, main_contact);
        memcpy(tangential[side], shifted.outcome.tracks[main_contact].tangential,
               sizeof tangential[side]);
    }
    /* over the step in speed */
    double step = 2.0 * SPEED_STEP * fabs(context->problem->gap_rate[main_contact]);
    solution->restitution_by_speed = (restitution[1] - restitution[0]) / step;
    bool rubs = oblique_of(context->problem, main_contact) != NULL;
    for (size_t t = 0; rubs && t < 2; t++)
        solution->tangential_by_speed[t] = (tangential[1][t] - tangential[0][t]) / step;
    return PERCUSS_OK;
}

/* FACTOR_COMPARED is for so many other solutions. */
static const double OTHERS = 4.0;

/* How many times its largest distance from the n others a solution may be wrong by. Of a long
 * sequence they may lie anywhere in a range: all are within a sixth of it from the answer once in
 * 3^4 times if there are four, within a sixth/3^(4/n - 1) if there are n. */
static double distance_factor(const struct attempt_context *context, const struct attempt *best)
{
    double others = (double)context->neighbours->solutions - 1.0;
    if (!attempt_is_long(best) || others < 1.0 || others >= OTHERS)
        return FACTOR_COMPARED;
    return FACTOR_COMPARED * pow(3.0, OTHERS / others - 1.0);
}

/* An answer that does not meet its tolerance may be any of the solutions near it: their distance is
 * its error. An unknown error is no less than the tolerance. */
static void solution_widen(const struct attempt_context *context, const struct attempt *best,
                           bool unknown, struct solution *solution)
{
    struct mode_error *modes = &solution->error.modes;
    double distance = neighbours_distance(context->neighbours, context->problem, &best->outcome);
    bool alone = context->neighbours->solutions < 2;
    double error = alone && !unknown ? 0.0 : distance_factor(context, best) * distance;
    error = larger(error, unknown ? context->problem->tolerance : 0.0) -
            solution->error.steps.restitution;
    if (error > modes->restitution) {
        modes->restitution = error;
        modes->impulse =
            larger(error * problem_largest_compression(context->problem), modes->impulse);
    }
}

/* Limits errors to the possible range. */
static void solution_bound(double range, double compression, double *restitution, double *impulse)
{
    if (*restitution > range) {
        *restitution = range;
        *impulse = smaller(*impulse, range * compression);
    }
}

/* Fills the answer and its errors from the best attempt. */
static void solution_conclude(const struct attempt_context *context, const struct attempt *best,
                              struct solution *solution)
{
    /* the best attempt */
    solution->assembly = best->assembly;
    solution->scene = &best->assembly->scene;
    solution->outcome = best->outcome;
    solution->log = attempt_is_followed(context, best) ? best->log : NULL;
    solution->path = best->path;
    solution->step_accuracy = best->accuracy;
    solution->step_profile = best->profile;
    /* an attempt cut off by its effort takes all that was left, but for a step */
    double allowed = attempt_work_allowed(context->problem->request->options.method);
    solution->spent = context->work < SPENT * allowed;
    solution->work = context->work;
    /* it was then compared with no other */
    bool unknown = solution->error.modes.verdict == MODES_UNCHECKED ||
                   solution->error.steps.unchecked || attempt_is_spent(best);
    solution->tolerance_met =
        solution->error.steps.energy_closes && !unknown &&
        solution->error.steps.restitution + solution->error.modes.restitution <=
            context->problem->tolerance;
    solution->farther = solution->tolerance_met ? FACTOR_COMPARED : distance_factor(context, best);
    if (!solution->tolerance_met && (attempt_is_sequence(best) || unknown))
        solution_widen(context, best, unknown, solution);
    /* sequences may amplify errors beyond the possible */
    double range = outcome_range(context->problem, &best->outcome);
    double compression = problem_largest_compression(context->problem);
    solution_bound(range, compression, &solution->error.steps.restitution,
                   &solution->error.steps.impulse);
    solution_bound(range, compression, &solution->error.modes.restitution,
                   &solution->error.modes.impulse);
}

/* Of the first time steps. Of a single contact with friction the tangential force decides, whose
 * error goes with the root of the accuracy. */
static double first_accuracy(const struct problem *problem, bool sequence)
{
    bool group = problem->contact_count > 1;
    double root = FRICTION_STEPS * problem->tolerance;
    if (problem->friction_count && !group && problem->tolerance > TOLERANCE_AUDITED)
        return smaller(root * root, MOST_STEPS_SEQUENCE);
    return attempt_first_accuracy(problem->tolerance, sequence, group);
}

/* By as many modes and as short steps as the tolerance asks for. */
static enum percuss_status solution_search(struct attempt_context *context,
                                           struct solution *solution)
{
    const struct problem *problem = context->problem;
    bool sequence = refinement_expects_sequence(problem);
    context->neighbours = arena_reserve(context->arena, 1, sizeof *context->neighbours);
    if (!context->neighbours)
        return PERCUSS_INTERNAL;
    context->neighbours->solutions = 0;
    *solution = (struct solution){.neighbours = context->neighbours,
                                  .restitution_by_speed = NAN,
                                  .tangential_by_speed = {NAN, NAN}};
    /* steps as the tolerance asks for to begin with, and as many modes */
    /* a tangential force bends within an impact */
    bool careful = sequence || problem->friction_count > 0;
    struct attempt best = {.accuracy = first_accuracy(problem, sequence),
                           .profile = careful ? STEP_PROFILE_SEQUENCE : STEP_PROFILE_SINGLE};
    enum percuss_status status = refine_modes(context, &best, &solution->error.modes);
    if (status)
        return status;
    /* steps as short, unless there is nothing to solve */
    if (!best.outcome.always_overlapped)
        status = refine_steps(context, &best, &solution->error.modes, &solution->error.steps);
    /* and the derivative by the speed */
    if (!status && !best.outcome.always_overlapped && problem->request->options.conditioning)
        status = find_conditioning(context, &best, solution);
    if (!status)
        solution_conclude(context, &best, solution);
    return status;
}

/* The scene of a model: stand-ins for the modes that it leaves out take part. False: out of memory.
 */
static bool make_scene(const struct problem *problem, const struct solution_model *model,
                       struct solution *solution)
{
    const struct mode_choice choice = {.cut = model->cut, .most = REFINEMENT_MOST_MODES};
    struct assembly *assembly = arena_take(problem->arena, 1, sizeof *assembly);
    struct scene *scene = arena_take(problem->arena, 1, sizeof *scene);
    bool made = assembly && scene && assemble(assembly, problem, &choice) &&
                assemble_remainder(assembly, problem, scene);
    solution->assembly = made ? assembly : NULL;
    solution->scene = made ? scene : NULL;
    return made;
}

/* Once, without an estimate of the error. */
static enum percuss_status solution_run(struct attempt_context *context,
                                        const struct solution_model *model,
                                        struct solution *solution)
{
    bool sequence = refinement_expects_sequence(context->problem);
    struct attempt attempt = {.accuracy = model->accuracy,
                              .profile = sequence ? STEP_PROFILE_SEQUENCE : STEP_PROFILE_SINGLE};
    if (!solution->scene && !make_scene(context->problem, model, solution))
        return PERCUSS_INTERNAL;
    enum percuss_status status = attempt_run(context, &attempt, solution->scene);
    solution->outcome = attempt.outcome;
    return status;
}

enum percuss_status solution_find(struct solution *solution, struct problem *problem,
                                  double tolerance, const struct solution_model *model,
                                  struct arena *arena, struct pace *pace, struct fault *fault)
{
    for (bool revised = false;; revised = true) {
        /* each time with all of the effort, within the search's own tolerance */
        struct problem searched = *problem;
        searched.tolerance = tolerance;
        struct attempt_context context = {
            .problem = &searched,
            .arena = arena,
            .pace = pace,
            .work = attempt_work_allowed(problem->request->options.method),
        };
        enum percuss_status status =
            model ? solution_run(&context, model, solution) : solution_search(&context, solution);
        solution->revised = revised;
        if (status)
            return pace_fault(fault, status);
        if (solution->outcome.always_overlapped)
            return outcome_refuse_overlap(problem, &solution->outcome,
                                          attempt_horizon(problem, solution->scene), fault);
        /* again where the solution contradicts the formulation */
        if (!formulation_revise(problem, solution->scene, &solution->outcome))
            return PERCUSS_OK;
        status = oblique_check(problem, fault);
        if (status)
            return status;
        solution->scene = NULL;
    }
}

struct solution_model solution_model_of(const struct solution *solution)
{
    return (struct solution_model){solution->assembly->highest * (1.0 + ROUNDING),
                                   solution->step_accuracy};
}
