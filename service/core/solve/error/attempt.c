/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/attempt.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "impact/coupling.h"
#include "impact/impact_scale.h"
#include "solve/error/calibration.h"
#include "solve/rate.h"

/* Sub-impacts of a contact from which on e is chaotic often enough (a fifth of the random heavy
 * balls on light beams from 30 on) that two solutions may agree within the tolerance and both be
 * wrong. */
enum { LONG = 10 };

/* Steps that are recorded of a solution, times contacts, 200 kB: a long sequence has more, and
 * little of it is of first order. */
enum { MOST_LOGGED = 2048 };

double attempt_work_allowed(enum percuss_method method)
{
    return method == PERCUSS_METHOD_CVODE ? MOST_WORK_CVODE : MOST_WORK;
}

double attempt_horizon(const struct problem *problem, const struct scene *scene)
{
    double asked = problem->request->options.horizon;
    return asked > 0.0 ? asked : larger(SOLVE_HORIZON, 2.0 * scene_longest_period(scene));
}

/* Once, with the attempt's profile. */
static enum percuss_status run_once(struct attempt_context *context, struct attempt *attempt,
                                    const struct scene *scene, struct force_log *log)
{
    struct impact_settings settings = {
        .accuracy = attempt->accuracy,
        .horizon = attempt_horizon(context->problem, scene),
        .max_work = context->work,
        .log = log,
        .pace = context->pace,
        .profile = attempt->profile,
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
    /* the others share the rest */
    context->work -= impact_work(scene, &attempt->outcome);
    return status;
}

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

static bool has_history(const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->curve || scene->laws[c].operations->remembers)
            return true;
    return false;
}

/* Longer steps than a sequence's are for laws that neither yield nor remember, as e depends on the
 * largest force else, which they miss; and a single impact's where it can be one. */
static void choose_profile(struct attempt *attempt, const struct scene *scene)
{
    bool single = attempt->profile == STEP_PROFILE_SINGLE;
    if (has_history(scene) || (single && (scene->contacts > 1 || is_pressed(scene))))
        attempt->profile = STEP_PROFILE_SEQUENCE;
}

/* Whether a solution with a single impact's profile is none: it closes again, or does not open. */
static bool needs_sequence(const struct attempt *attempt)
{
    if (attempt->profile != STEP_PROFILE_SINGLE || attempt->outcome.always_overlapped)
        return false;
    return attempt->outcome.tracks[0].count > 1 ||
           attempt->outcome.end_reason == PERCUSS_END_IN_CONTACT;
}

enum percuss_status attempt_run(struct attempt_context *context, struct attempt *attempt,
                                const struct scene *scene)
{
    choose_profile(attempt, scene);
    enum percuss_status status = run_once(context, attempt, scene, NULL);
    if (status || !needs_sequence(attempt))
        return status;
    attempt->profile = STEP_PROFILE_SEQUENCE;
    return run_once(context, attempt, scene, NULL);
}

/* How much forces of row b move row a during a contact: rigid bodies, modes, which follow the
 * slower the lower they are, and residual flexibility; each by its magnitude, 1/kg. */
static double moves(const struct scene *scene, size_t a, size_t b, double duration)
{
    size_t at = a * scene->rows + b;
    double sum = fabs(scene->w[at]) + fabs(scene->residual[at]) / (duration * duration);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *first = group->participation[a], *second = group->participation[b];
        for (size_t k = 0; first && second && k < group->count; k++) {
            double turn = group->set->omega[k] * duration;
            sum += fabs(first[k] * second[k]) / (1.0 + turn * turn);
        }
    }
    return sum;
}

/* Whether tangential forces hardly move the contacts along their normals: then first order along
 * the normal forces alone tells what changes do to these. */
static bool friction_is_weak(const struct scene *scene)
{
    for (size_t c = 0; scene->frictions && c < scene->contacts; c++) {
        double duration = impact_scale_of(scene, c, fabs(scene->gap_rate[c])).duration;
        double by_tangents = 0.0;
        for (size_t r = scene->contacts; r < scene->rows; r++)
            by_tangents += scene->friction[(r - scene->contacts) / 2].coefficient *
                           moves(scene, c, r, duration);
        if (!(by_tangents <= WEAK_FRICTION * moves(scene, c, c, duration)))
            return false;
    }
    return true;
}

enum percuss_status attempt_run_logged(struct attempt_context *context, struct attempt *attempt,
                                       const struct scene *scene)
{
    if (scene->contacts > COUPLING_FEW || !friction_is_weak(scene))
        return attempt_run(context, attempt, scene);
    /* a single impact needs none */
    choose_profile(attempt, scene);
    if (attempt->profile == STEP_PROFILE_SINGLE) {
        enum percuss_status status = run_once(context, attempt, scene, NULL);
        if (status || !needs_sequence(attempt))
            return status;
        attempt->profile = STEP_PROFILE_SEQUENCE;
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
    size_t rows = problem_rows(context->problem);
    struct scene scene = attempt->assembly->scene;
    double *scaled = arena_take(context->arena, rows, sizeof *scaled);
    if (!scaled)
        return PERCUSS_INTERNAL;
    for (size_t r = 0; r < rows; r++)
        scaled[r] = factor * scene.gap_rate[r];
    scene.gap_rate = scaled;
    enum percuss_status status = rate_follow(context->problem, factor, &scene);
    if (!status)
        status = attempt_run(context, attempt, &scene);
    for (size_t c = 0; !status && c < n; c++)
        attempt->outcome.tracks[c].impulse /= factor;
    return status;
}

double attempt_steps_leave(double accuracy)
{
    return STEPS_LEFT * pow(accuracy, STEPS_LEFT_POWER);
}

bool attempt_can_shorten(double accuracy)
{
    return accuracy > 1.01 * FINEST_STEPS;
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
           !scene_is_lossy(&attempt->assembly->scene) &&
           problem_largest_compression(context->problem) > 0.0;
}

/* The audit must close to 1e-9 where the tolerance is 1e-8 or less. In groups contacts open and
 * close within steps. Longer steps for comparison than those of 2e-4 do not exist. */
double attempt_first_accuracy(double tolerance, bool sequence, bool group)
{
    bool followed = tolerance < TOLERANCE_FOLLOWED && tolerance >= TOLERANCE_FOLLOWED_FINE;
    bool fine = tolerance <= TOLERANCE_AUDITED || group || (sequence && followed);
    double share = fine ? FIRST_STEPS_FINE : sequence ? FIRST_STEPS_SEQUENCE : FIRST_STEPS_SINGLE;
    double most = group ? MOST_STEPS_GROUP : sequence ? MOST_STEPS_SEQUENCE : INFINITY;
    return larger(smaller(share * tolerance, most), FINEST_STEPS);
}

/* Effect of omitting mode k, as row r sees it, on the impulse of the row's contact, as a part of
 * that of compression: its response to a slow force lacks inertia and viscosity (struct omitted in
 * assembly.h). The force along a tangent counts as one like the contact's: as a static flexibility
 * alone a slow mode would let the surfaces go with each other. */
static double omission_effect(const struct problem *problem, const struct impact_outcome *answer,
                              const struct scene_group *group, size_t k, size_t r)
{
    size_t contact = problem_row_contact(problem, r);
    const struct track *track = &answer->tracks[contact];
    double compression = problem->impulse_compression[contact];
    double omega = group->set->omega[k];
    double share = group->participation[r][k] / omega;
    double inertia = share * share / (omega * omega) * track->inertia;
    double viscosity = 2.0 * group->set->damping[k] * share * share / omega * track->viscosity;
    double rate = compression * problem->w[contact * (problem->contact_count + 1)];
    return compression > 0.0 ? (fabs(inertia) + viscosity / rate) / compression : 0.0;
}

/* How many modes of a group stay: whole lanes. */
static size_t count_kept(const struct problem *problem, const struct impact_outcome *answer,
                         const struct scene_group *group, double allowed)
{
    double sum[SCENE_MOST_ROWS] = {0.0};
    if (group->q || group->v)
        return group->count;
    for (size_t left = group->count; left > 0; left--)
        for (size_t r = 0; r < problem_rows(problem); r++) {
            if (!group->participation[r])
                continue;
            sum[r] += omission_effect(problem, answer, group, left - 1, r);
            if (sum[r] > allowed)
                return (left + LANES - 1) / LANES * LANES;
        }
    return 0;
}

bool attempt_truncate(const struct problem *problem, const struct scene *scene,
                      const struct impact_outcome *answer, double allowed, struct scene *truncated)
{
    size_t n = scene->rows;
    double *residual = arena_take(problem->arena, n * n, sizeof *residual);
    *truncated = *scene;
    truncated->group = arena_take(problem->arena, scene->groups, sizeof *truncated->group);
    if (!residual || !truncated->group)
        return false;
    memcpy(residual, scene->residual, n * n * sizeof *residual);
    truncated->residual = residual;
    truncated->groups = 0;
    for (size_t g = 0; g < scene->groups; g++) {
        /* each group takes its part of the allowed effect */
        const struct scene_group *group = &scene->group[g];
        size_t left = count_kept(problem, answer, group, allowed / (double)scene->groups);
        for (size_t k = left; k < group->count; k++) {
            double flexibility = 1.0 / (group->set->omega[k] * group->set->omega[k]);
            for (size_t i = 0; i < n * n; i++) {
                const double *a = group->participation[i / n];
                const double *b = group->participation[i % n];
                if (a && b)
                    residual[i] += a[k] * b[k] * flexibility;
            }
        }
        if (left == 0)
            continue;
        truncated->group[truncated->groups] = *group;
        if (left < group->count)
            truncated->group[truncated->groups].count = truncated->group[truncated->groups].stride =
                left;
        truncated->groups++;
    }
    return true;
}

bool attempt_followed_scene(const struct problem *problem, const struct scene *scene,
                            const struct impact_outcome *answer, struct scene *followed)
{
    struct scene truncated;
    return attempt_truncate(problem, scene, answer, TRUNCATED_FIRST_ORDER, &truncated) &&
           scene_normals(&truncated, problem->arena, followed);
}
