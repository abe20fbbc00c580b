/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/attempt.h"

#include <math.h>
#include <stdio.h>

/* Most of a second by the modal method, whose steps cost some 20 ns of that each; CVODE's
 * right-hand sides are many more and cheaper. */
static const double MAX_WORK = 3e7;
static const double MAX_WORK_CVODE = 4e9;

/* Sub-impacts of a contact from which on e is chaotic often enough (a fifth of the random heavy
 * balls on light beams from 30 on) that two solutions may agree within the tolerance and both be
 * wrong. */
enum { LONG = 10 };

double attempt_work_allowed(enum percuss_method method)
{
    return method == PERCUSS_METHOD_CVODE ? MAX_WORK_CVODE : MAX_WORK;
}

double attempt_horizon(const struct problem *problem, const struct scene *scene)
{
    double asked = problem->request->options.horizon;
    return asked > 0.0 ? asked : fmax(SOLVE_HORIZON, 2.0 * scene_longest_period(scene));
}

enum percuss_status attempt_run(struct attempt_context *context, struct attempt *attempt,
                                const struct scene *scene)
{
    struct impact_settings settings = {
        .accuracy = attempt->accuracy,
        .horizon = attempt_horizon(context->problem, scene),
        .max_work = context->work,
        .pace = context->pace,
    };
    if (!impact_create(&attempt->outcome, scene, context->arena))
        return PERCUSS_INTERNAL;
    enum percuss_status status;
    if (context->problem->request->options.method == PERCUSS_METHOD_CVODE)
        status = impact_cvode(scene, &settings, context->arena, &attempt->outcome);
    else if (impact_is_rigid_pair(scene))
        status = impact_rigid_pair(scene, &settings, context->arena, &attempt->outcome);
    else
        status = impact_modal(scene, &settings, context->arena, &attempt->outcome);
    context->work -= impact_work(scene, &attempt->outcome);
    return status;
}

enum percuss_status attempt_assemble(struct attempt_context *context, struct attempt *attempt)
{
    attempt->assembly = arena_take(context->arena, 1, sizeof *attempt->assembly);
    return attempt->assembly && assemble(attempt->assembly, context->problem, &attempt->choice)
               ? PERCUSS_OK
               : PERCUSS_INTERNAL;
}

enum percuss_status attempt_run_scaled(struct attempt_context *context, struct attempt *attempt,
                                       double factor)
{
    size_t n = context->problem->contact_count;
    struct scene scene = attempt->assembly->scene;
    double *scaled = arena_take(context->arena, n, sizeof *scaled);
    if (!scaled)
        return PERCUSS_INTERNAL;
    for (size_t c = 0; c < n; c++)
        scaled[c] = factor * scene.gap_rate[c];
    scene.gap_rate = scaled;
    enum percuss_status status = attempt_run(context, attempt, &scene);
    for (size_t c = 0; !status && c < n; c++)
        attempt->outcome.tracks[c].impulse /= factor;
    return status;
}

bool attempt_is_unsolved(const struct problem *problem, const struct impact_outcome *outcome)
{
    bool touched = false;
    for (size_t c = 0; c < problem->contact_count; c++)
        touched = touched || outcome->tracks[c].impulse > 0.0;
    return outcome->end_reason == PERCUSS_END_LIMIT && !touched;
}

double attempt_restitution(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact)
{
    double compression = problem->impulse_compression[contact];
    return compression > 0.0 ? outcome->tracks[contact].impulse / compression - 1.0 : NAN;
}

enum percuss_status attempt_refuse_overlap(const struct attempt_context *context,
                                           const struct attempt *attempt, double horizon,
                                           struct fault *fault)
{
    const struct problem *problem = context->problem;
    bool group = problem->contact_count > 1;
    size_t deepest = 0;
    for (size_t c = 1; c < problem->contact_count; c++)
        if (context->problem->request->contacts[c].gap <
            context->problem->request->contacts[deepest].gap)
            deepest = c;
    char within[96] = "";
    if (attempt->outcome.beyond_horizon)
        snprintf(within, sizeof within, " within options.horizon (%g s) before: raise it", horizon);
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "contacts[%zu].gap: %g m: the bodies overlap, and at the stated gap rate (%g m/s), "
        "acceleration and vibration %s%s",
        deepest, context->problem->request->contacts[deepest].gap, problem->gap_rate[deepest],
        group ? "there was no instant at which every contact was open" : "they never touched",
        within[0] ? within : " before");
}

struct attempt_difference attempt_compare(const struct attempt_context *context,
                                          const struct attempt *a, const struct attempt *b)
{
    struct attempt_difference largest = {0.0, 0.0};
    for (size_t c = 0; c < context->problem->contact_count; c++) {
        double change = fabs(a->outcome.tracks[c].impulse - b->outcome.tracks[c].impulse);
        double compression = context->problem->impulse_compression[c];
        largest.impulse = fmax(largest.impulse, change);
        if (compression > 0.0)
            largest.restitution = fmax(largest.restitution, change / compression);
    }
    return largest;
}

bool attempt_is_spent(const struct attempt *attempt)
{
    return attempt->outcome.end_reason == PERCUSS_END_LIMIT;
}

bool attempt_is_sequence(const struct attempt *attempt)
{
    size_t contacts = attempt->assembly->scene.contacts;
    for (size_t c = 0; c < contacts; c++)
        if (attempt->outcome.tracks[c].count > 1)
            return true;
    return contacts > 1;
}

bool attempt_is_long(const struct attempt *attempt)
{
    for (size_t c = 0; c < attempt->assembly->scene.contacts; c++)
        if (attempt->outcome.tracks[c].count >= LONG)
            return true;
    return false;
}

double attempt_energy_defect(const struct problem *problem, const struct impact_outcome *outcome)
{
    double approach = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        approach += 0.5 * problem->impulse_compression[c] * fabs(problem->gap_rate[c]);
    double lost = fabs(outcome->energy.closure);
    // the slowest approach of all has no energy that doubles can hold
    return lost == 0.0 ? 0.0 : lost / fmax(outcome->energy.available, approach);
}

bool attempt_keeps_energy(double defect)
{
    return defect <= ATTEMPT_WORST_DEFECT;
}
