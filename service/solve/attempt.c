/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/attempt.h"

#include <math.h>

#include "impact/coupling.h"
#include "impact/impact_scale.h"

/* Most of a second by the modal method, whose steps cost some 20 ns of that each; CVODE's
 * right-hand sides are many more and cheaper. */
static const double MAX_WORK = 3e7;
static const double MAX_WORK_CVODE = 4e9;

/* Sub-impacts of a contact from which on e is chaotic often enough (a fifth of the random heavy
 * balls on light beams from 30 on) that two solutions may agree within the tolerance and both be
 * wrong. */
enum { LONG = 10 };

/* Steps that are taken down of a solution, times contacts, 200 kB: a long sequence has more, and
 * little of it is of first order. */
enum { MOST_LOGGED = 2048 };

double attempt_work_allowed(enum percuss_method method)
{
    return method == PERCUSS_METHOD_CVODE ? MAX_WORK_CVODE : MAX_WORK;
}

double attempt_horizon(const struct problem *problem, const struct scene *scene)
{
    double asked = problem->request->options.horizon;
    return asked > 0.0 ? asked : fmax(SOLVE_HORIZON, 2.0 * scene_longest_period(scene));
}

/* Once, with the attempt's care. */
static enum percuss_status run_once(struct attempt_context *context, struct attempt *attempt,
                                    const struct scene *scene, struct force_log *log)
{
    struct impact_settings settings = {
        .accuracy = attempt->accuracy,
        .horizon = attempt_horizon(context->problem, scene),
        .max_work = context->work,
        .log = log,
        .pace = context->pace,
        .care = attempt->care,
    };
    attempt->log = log;
    attempt->path = NULL;
    if (!impact_create(&attempt->outcome, scene, context->arena))
        return PERCUSS_INTERNAL;
    /* the method asked for, or the closed form where that is exact */
    enum percuss_status status;
    if (context->problem->request->options.method == PERCUSS_METHOD_CVODE)
        status = impact_cvode(scene, &settings, context->arena, &attempt->outcome);
    else if (impact_is_rigid_pair(scene))
        status = impact_rigid_pair(scene, &settings, context->arena, &attempt->outcome);
    else
        status = impact_modal(scene, &settings, context->arena, &attempt->outcome);
    /* what it took is no longer there for the others */
    context->work -= impact_work(scene, &attempt->outcome);
    return status;
}

/* Share of the approach's energy that the work of acceleration on the contact may be for one that
 * is a single blow: what steps lose is a share of both. */
static const double PRESSED = 0.1;

/* Whether acceleration moves the only contact as much as its approach does. */
static bool is_pressed(const struct scene *scene)
{
    double acceleration = fabs(scene->gap_acceleration[0]);
    double speed = fabs(scene->gap_rate[0]);
    if (acceleration == 0.0)
        return false;
    struct impact_scale scale = impact_scale_of(scene, 0, speed);
    return !(2.0 * acceleration * scale.indentation <= PRESSED * speed * speed);
}

static bool yields(const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->curve)
            return true;
    return false;
}

/* Longer steps than a sequence's are for laws that do not yield, as e depends on the largest force
 * else, which they miss; and a single blow's for what can be one. */
static void choose_care(struct attempt *attempt, const struct scene *scene)
{
    bool single = attempt->care == IMPACT_CARE_SINGLE;
    if (yields(scene) || (single && (scene->contacts > 1 || is_pressed(scene))))
        attempt->care = IMPACT_CARE_SEQUENCE;
}

/* Whether what was solved with a single blow's care is none: it closes again, or does not open. */
static bool is_careless(const struct attempt *attempt)
{
    if (attempt->care != IMPACT_CARE_SINGLE || attempt->outcome.always_overlapped)
        return false;
    return attempt->outcome.tracks[0].count > 1 ||
           attempt->outcome.end_reason == PERCUSS_END_IN_CONTACT;
}

enum percuss_status attempt_run(struct attempt_context *context, struct attempt *attempt,
                                const struct scene *scene)
{
    choose_care(attempt, scene);
    enum percuss_status status = run_once(context, attempt, scene, NULL);
    if (status || !is_careless(attempt))
        return status;
    attempt->care = IMPACT_CARE_SEQUENCE;
    return run_once(context, attempt, scene, NULL);
}

enum percuss_status attempt_run_logged(struct attempt_context *context, struct attempt *attempt,
                                       const struct scene *scene)
{
    if (scene->contacts > COUPLING_FEW)
        return attempt_run(context, attempt, scene);
    /* a single blow asks for none */
    choose_care(attempt, scene);
    if (attempt->care == IMPACT_CARE_SINGLE) {
        enum percuss_status status = run_once(context, attempt, scene, NULL);
        if (status || !is_careless(attempt))
            return status;
        attempt->care = IMPACT_CARE_SEQUENCE;
    }
    struct force_log *log = arena_take(context->arena, 1, sizeof *log);
    if (!log)
        return PERCUSS_INTERNAL;
    *log = force_log_make(context->arena, scene->contacts);
    log->most = MOST_LOGGED / scene->contacts;
    return run_once(context, attempt, scene, log);
}

enum percuss_status attempt_assemble(struct attempt_context *context, struct attempt *attempt)
{
    attempt->assembly = arena_take(context->problem->arena, 1, sizeof *attempt->assembly);
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

/* LEFT accuracy^POWER */
static const double LEFT = 0.1;
static const double POWER = 0.8;

double attempt_steps_leave(double accuracy)
{
    return LEFT * pow(accuracy, POWER);
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

bool attempt_is_followed(const struct attempt_context *context, const struct attempt *attempt)
{
    const struct force_log *log = attempt->log;
    return log && log->complete && log->count > 0 && !attempt_is_long(attempt) &&
           !attempt_is_spent(attempt) && attempt->outcome.plastic == 0.0 &&
           problem_largest_compression(context->problem) > 0.0;
}
