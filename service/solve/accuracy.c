/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/accuracy.h"

#include <math.h>
#include <string.h>

#include "solve/formulation.h"

/* d(restitution)/d(speed) of the contact with the largest impulse, by central difference with all
 * gap rates scaled. */
static enum percuss_status find_conditioning(struct attempt_context *context,
                                             const struct attempt *best, double *by_speed)
{
    const double step = 1e-5;
    const struct track *tracks = best->outcome.tracks;
    size_t main_contact = 0;
    for (size_t c = 1; c < context->problem->contact_count; c++)
        if (tracks[c].impulse > tracks[main_contact].impulse)
            main_contact = c;
    double restitution[2];
    for (int side = 0; side < 2; side++) {
        struct attempt shifted = *best;
        shifted.accuracy = fmin(best->accuracy, 1e-9);
        enum percuss_status status =
            attempt_run_scaled(context, &shifted, side == 0 ? 1.0 - step : 1.0 + step);
        if (status || attempt_is_spent(&shifted))
            return status;
        restitution[side] = attempt_restitution(context->problem, &shifted.outcome, main_contact);
    }
    *by_speed = (restitution[1] - restitution[0]) /
                (2.0 * step * fabs(context->problem->gap_rate[main_contact]));
    return PERCUSS_OK;
}

static double largest_compression(const struct problem *problem)
{
    double largest = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        largest = fmax(largest, problem->impulse_compression[c]);
    return largest;
}

/* The width of what a restitution can be, from no impulse (-1) to a full rebound, or what it is. */
static double possible_range(const struct attempt_context *context, const struct attempt *best)
{
    double most = 1.0;
    for (size_t c = 0; c < context->problem->contact_count; c++)
        most = fmax(most, attempt_restitution(context->problem, &best->outcome, c));
    return 1.0 + most;
}

/* An answer that does not meet its tolerance is one of those beside it. What is unknown is no less
 * than the tolerance. */
static void widen(const struct attempt_context *context, const struct attempt *best, bool unknown,
                  struct accuracy *accuracy)
{
    struct mode_error *modes = &accuracy->modes;
    double distance = nearby_distance(context->nearby, context->problem, &best->outcome);
    bool alone = context->nearby->solutions < 2;
    double error = alone && !unknown ? 0.0 : SEQUENCE_FACTOR * distance;
    error = fmax(error, unknown ? context->tolerance : 0.0) - accuracy->steps.restitution;
    if (error > modes->restitution) {
        modes->restitution = error;
        modes->impulse = fmax(modes->impulse, error * largest_compression(context->problem));
    }
}

/* Errors that are wider than what is possible. */
static void bound(double range, double compression, double *restitution, double *impulse)
{
    if (*restitution > range) {
        *restitution = range;
        *impulse = fmin(*impulse, range * compression);
    }
}

/* What the searches found, in the terms of the answer. */
static void conclude(const struct attempt_context *context, const struct attempt *best,
                     struct accuracy *accuracy)
{
    accuracy->assembly = best->assembly;
    accuracy->outcome = best->outcome;
    accuracy->step_accuracy = best->accuracy;
    /* what was cut off was compared with nothing */
    bool unknown = accuracy->modes.unchecked || accuracy->steps.unchecked || attempt_is_spent(best);
    accuracy->tolerance_met =
        accuracy->steps.energy_closes && !unknown &&
        accuracy->steps.restitution + accuracy->modes.restitution <= context->tolerance;
    if (!accuracy->tolerance_met && (attempt_is_sequence(best) || unknown))
        widen(context, best, unknown, accuracy);
    /* what sequences amplify beyond all bounds */
    double range = possible_range(context, best);
    double compression = largest_compression(context->problem);
    bound(range, compression, &accuracy->steps.restitution, &accuracy->steps.impulse);
    bound(range, compression, &accuracy->modes.restitution, &accuracy->modes.impulse);
}

static enum percuss_status search(struct accuracy *accuracy, const struct problem *problem,
                                  struct pace *pace, struct fault *fault)
{
    const struct solve_options *options = &problem->request->options;
    struct attempt_context context = {
        .problem = problem,
        .request = problem->request,
        .arena = problem->arena,
        .pace = pace,
        .tolerance = problem->tolerance,
        .work = attempt_work_allowed(problem->request->options.method),
        .nearby = &accuracy->nearby,
    };
    bool sequence = mode_search_expects_sequence(problem);
    struct attempt best = {.accuracy = step_search_first_accuracy(context.tolerance, sequence,
                                                                  problem->contact_count > 1)};
    memset(accuracy, 0, sizeof *accuracy);
    accuracy->restitution_by_speed = NAN;
    enum percuss_status status = mode_search(&context, &best, &accuracy->modes);
    if (!status && best.outcome.always_overlapped)
        return attempt_refuse_overlap(&context, &best,
                                      attempt_horizon(problem, &best.assembly->scene), fault);
    if (!status)
        status = step_search(&context, &best, &accuracy->modes, &accuracy->steps);
    if (!status && options->conditioning)
        status = find_conditioning(&context, &best, &accuracy->restitution_by_speed);
    if (status)
        return pace_fault(fault, status);
    /* what is cut off for its effort takes all that was left, but for a step */
    accuracy->spent = context.work < 1e-3 * attempt_work_allowed(options->method);
    conclude(&context, &best, accuracy);
    return PERCUSS_OK;
}

enum percuss_status accuracy_reach(struct accuracy *accuracy, struct problem *problem,
                                   struct pace *pace, struct fault *fault)
{
    enum percuss_status status;
    do
        status = search(accuracy, problem, pace, fault);
    while (!status && formulation_revise(problem, &accuracy->assembly->scene, &accuracy->outcome));
    return status;
}
