/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/tracing.h"

#include <math.h>

#include "impact/trace.h"
#include "model/rigid.h"
#include "model/vector.h"
#include "solve/report.h"

/* Share of the window by which the last instant kept may lie before its end. */
static const double LAST_INSTANT = 0.01;
/* A larger difference of restitutions is that of two methods. */
static const double SAME_METHOD = 1e-9;
/* Accuracy of steps that stand for a closed form, to as many digits. */
static const double CLOSED_FORM = 1e-9;

/* Compliance between two contacts of one body that no mode of the scene holds. */
static double residual_of_side(const struct problem *problem, const struct assembly *assembly,
                               const struct contact_side *i, const struct contact_side *j,
                               size_t contact_i, size_t contact_j)
{
    double sum = 0.0;
    const struct body *body = problem->bodies[i->body];
    for (size_t f = 0; f < body->kind->family_count; f++)
        sum += modal_compliance(body, f, &i->load.family[f], &j->load.family[f]);
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        const double *a = group->participation[contact_i];
        const double *b = group->participation[contact_j];
        if (group->body != i->body)
            continue;
        for (size_t k = group->count; a && b && k-- > 0;)
            sum -= a[k] * b[k] / (group->set->omega[k] * group->set->omega[k]);
    }
    return sum;
}

/* The part of the coupling of two contacts that goes through side `which` of the first. */
static void share_of_side(const struct problem *problem, const struct assembly *assembly, size_t c,
                          int which, double *w, double *residual)
{
    const struct contact_side *side = &problem->sides[c][which];
    const struct body *body = problem->bodies[side->body];
    size_t n = problem->contact_count;
    residual[c * n + c] = problem->compliance.sides[c][which];
    for (size_t j = 0; j < n; j++) {
        for (int q = 0; q < 2; q++) {
            const struct contact_side *other = &problem->sides[j][q];
            if (other->body != side->body)
                continue;
            w[c * n + j] += rigid_inverse_mass(body, side->site.point, side->direction,
                                               other->site.point, other->direction);
            residual[c * n + j] += residual_of_side(problem, assembly, side, other, c, j);
        }
    }
}

static double velocity_along_normal(const struct solve_request *request, size_t contact,
                                    size_t body)
{
    const struct solve_contact *at = &request->contacts[contact];
    const struct solve_body *moving = &request->bodies[body];
    double arm[3];
    double turning[3];
    sub3(at->point, moving->position, arm);
    cross3(moving->angular_velocity, arm, turning);
    return dot3(at->normal, moving->velocity) + dot3(at->normal, turning);
}

/* How the two bodies share each contact. With the client's own W nobody knows. */
static bool find_sides(const struct problem *problem, const struct assembly *assembly,
                       struct trace_sides *sides)
{
    struct arena *arena = problem->arena;
    size_t n = problem->contact_count;
    *sides = (struct trace_sides){0};
    for (int s = 0; s < 2 && !problem->from_client; s++) {
        /* the four arrays of this side */
        double *w = arena_take(arena, n * n, sizeof *w);
        double *residual = arena_take(arena, n * n, sizeof *residual);
        double *velocity = arena_take(arena, n, sizeof *velocity);
        size_t *body = arena_take(arena, n, sizeof *body);
        if (!w || !residual || !velocity || !body)
            return false;
        /* contact by contact */
        for (size_t c = 0; c < n; c++) {
            body[c] = problem->sides[c][s].body;
            velocity[c] = velocity_along_normal(problem->request, c, body[c]);
            share_of_side(problem, assembly, c, s, w, residual);
        }
        sides->w[s] = w;
        sides->residual[s] = residual;
        sides->velocity[s] = velocity;
        sides->body[s] = body;
    }
    return true;
}

/* What any solution may take; one that was cut off is cut off again. */
static double work_of(const struct solution *solution)
{
    double allowed = attempt_work_allowed(PERCUSS_METHOD_MODAL);
    double taken = impact_work(&solution->assembly->scene, &solution->outcome);
    return solution->outcome.end_reason == PERCUSS_END_LIMIT ? fmin(taken, allowed) : allowed;
}

/* Where the effort did not do for all of it, and where the answer came from another method. */
static void warn(const struct problem *problem, const struct solution *solution,
                 const struct impact_outcome *again, struct solve_result *result)
{
    const struct trace *trace = result->trace;
    double last = trace->time[trace->count - 1];
    /* the last instant that is kept may lie a little before the end */
    if (last < result->window - LAST_INSTANT * fabs(result->window)) {
        report_warn(result,
                    "options.trace: the histories end at %g s of %g s: the effort allowed for them "
                    "was spent",
                    last, result->window);
        return;
    }
    /* another method, another answer */
    double off = outcome_compare(problem, again, &solution->outcome).restitution;
    if (off > SAME_METHOD)
        report_warn(result,
                    "options.trace: the histories are the modal method's, whose restitution "
                    "differs by %.2g from the answer",
                    off);
}

enum percuss_status tracing_make(const struct problem *problem, const struct solution *solution,
                                 struct pace *pace, struct solve_result *result)
{
    struct arena *arena = problem->arena;
    const struct scene *scene = &solution->assembly->scene;
    struct force_log log = force_log_make(arena, scene->contacts);
    struct impact_settings settings = {.accuracy = solution->step_accuracy,
                                       .horizon = attempt_horizon(problem, scene),
                                       .max_work = work_of(solution),
                                       .log = &log,
                                       .pace = pace,
                                       .care = solution->step_care};
    /* the closed form of a rigid pair is exact */
    if (impact_is_rigid_pair(scene))
        settings.accuracy = fmin(settings.accuracy, CLOSED_FORM);
    /* the same solution once more, with a log of its forces */
    struct impact_outcome again;
    struct trace_sides sides;
    struct trace *trace = arena_take(arena, 1, sizeof *trace);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (trace && impact_create(&again, scene, arena) &&
        find_sides(problem, solution->assembly, &sides))
        status = impact_modal(scene, &settings, arena, &again);
    if (!status)
        status =
            trace_make(&(struct trace_task){scene, &log, &sides, again.time_shift, again.window,
                                            attempt_work_allowed(PERCUSS_METHOD_MODAL), pace},
                       arena, trace);
    if (status) {
        result->status = pace_fault(&result->fault, status);
        return result->status;
    }
    result->trace = trace;
    warn(problem, solution, &again, result);
    return result->status;
}
