/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/model_perturbed.h"

#include <math.h>
#include <string.h>

#include "contact/plastic.h"
#include "solve/attempt.h"
#include "solve/contact_model.h"
#include "solve/fewer.h"
#include "solve/law_error.h"
#include "solve/outcome.h"

/* Longest steps of solutions beside a sequence, as accuracy (impact_settings), and of groups, whose
 * contacts open and close within steps: what they say of e is that of fine steps to 2 % of 7 in 8
 * random scenes. */
static const double LONGEST = 1e-3;
static const double LONGEST_GROUP = 1e-4;
/* Work that one of them may take, in those of the answer. */
static const double EFFORT = 3.0;
/* Which deviations a solution beside the answer has: all contacts softer or stiffer, every other
 * one so, or all yielding later or earlier. */
struct direction {
    bool alternate, flow;
    double sign;
};

static void deviate(const struct model_margin *margin, const struct direction *direction, size_t c,
                    struct contact_law *law, double *compliance)
{
    const struct model_deviation *deviation = &margin->deviation[c];
    double sign = direction->alternate && c % 2 ? -direction->sign : direction->sign;
    if (direction->flow) {
        double depth = margin->blow[c].history.max_indentation;
        if (!(deviation->yield > 0.0 && law->operations->curve))
            return;
        double yield = law_error_yield(law, depth, deviation->yield);
        *law = contact_law_rescaled(law, 1.0, sign > 0.0 ? yield : 1.0 / yield);
        return;
    }
    struct model_stiffening stiffer = model_deviation_stiffening(deviation, &margin->blow[c]);
    *law = contact_law_rescaled(law, exp(sign * stiffer.force), 1.0);
    *compliance += sign * stiffer.compliance;
}

static bool make_scene(const struct model_margin *margin, const struct direction *direction,
                       struct scene *scene)
{
    size_t n = margin->problem->contact_count;
    struct arena *arena = margin->problem->arena;
    struct contact_law *laws = arena_take(arena, n, sizeof *laws);
    double *residual = arena_take(arena, n * n, sizeof *residual);
    if (!laws || !residual)
        return false;
    memcpy(laws, scene->laws, n * sizeof *laws);
    memcpy(residual, scene->residual, n * n * sizeof *residual);
    for (size_t c = 0; c < n; c++)
        deviate(margin, direction, c, &laws[c], &residual[c * n + c]);
    scene->laws = laws;
    scene->residual = residual;
    return true;
}

static bool by_finite_elements(const struct problem *problem)
{
    enum percuss_contact_model asked = problem->request->options.contact_model;
    return contact_law_asked(asked)->method == CONTACT_CONCURRENT;
}

/* What solutions beside the answer share: what each of them leaves of the effort is the others'. */
struct beside {
    const struct model_margin *margin;
    struct attempt_context context;
    const struct impact_outcome *answer; /* that they are compared with */
    struct scene scene;                  /* that they deviate from */
};

/* How far solutions are from the answer; INFINITY: nobody knows. */
struct distance {
    double restitution; /* largest of a contact */
    double *impulse;    /* [contact], N s */
};

/* Solves a scene, and widens the distance to its own. */
static enum percuss_status solve_beside(struct beside *beside, const struct scene *scene,
                                        struct attempt *attempt, struct distance *distance)
{
    const struct solution *solution = beside->margin->solution;
    double left = beside->context.work;
    double allowed = EFFORT * impact_work(solution->scene, &solution->outcome);
    double before = distance->restitution;
    distance->restitution = INFINITY;
    if (solution->spent || solution->outcome.end_reason == PERCUSS_END_LIMIT)
        return PERCUSS_OK;
    /* no more than a few times the answer's own effort, where that is of the same kind */
    allowed = by_finite_elements(beside->margin->problem) ? left : fmin(left, allowed);
    bool modal = beside->margin->problem->request->options.method == PERCUSS_METHOD_MODAL;
    double longest = scene->contacts > 1 ? LONGEST_GROUP : LONGEST;
    *attempt = (struct attempt){.accuracy = fmax(solution->step_accuracy, modal ? longest : 0.0),
                                .assembly = solution->assembly,
                                .care = IMPACT_CARE_ROUGH};
    beside->context.work = allowed;
    enum percuss_status status = attempt_run(&beside->context, attempt, scene);
    beside->context.work += left - allowed;
    if (status || attempt_is_spent(attempt) || attempt->outcome.always_overlapped)
        return status;
    const struct problem *problem = beside->margin->problem;
    distance->restitution =
        fmax(before, outcome_compare(problem, beside->answer, &attempt->outcome).restitution);
    outcome_widen_impulses(problem, beside->answer, &attempt->outcome, distance->impulse);
    return PERCUSS_OK;
}

/* The larger one of two distances along a direction and against it. */
static enum percuss_status along(struct beside *beside, bool flow, struct distance *largest)
{
    bool group = beside->margin->problem->contact_count > 1;
    for (int i = 0; i < 2 && !isinf(largest->restitution); i++) {
        struct direction direction = {
            .alternate = group && i, .flow = flow, .sign = i && !group ? 1.0 : -1.0};
        struct scene scene = beside->scene;
        struct attempt attempt;
        if (!make_scene(beside->margin, &direction, &scene))
            return PERCUSS_INTERNAL;
        enum percuss_status status = solve_beside(beside, &scene, &attempt, largest);
        if (status)
            return status;
    }
    return PERCUSS_OK;
}

static void widen(const struct problem *problem, const struct distance *spring,
                  const struct distance *flow, double *restitution, double *impulse)
{
    double both = hypot(spring->restitution, flow->restitution);
    *restitution = fmax(*restitution, MODEL_PERTURBED_BETWEEN * both);
    for (size_t c = 0; c < problem->contact_count; c++) {
        double change = isinf(both) ? INFINITY : hypot(spring->impulse[c], flow->impulse[c]);
        impulse[c] = fmax(impulse[c], MODEL_PERTURBED_BETWEEN * change);
    }
}

enum percuss_status model_perturbed_find(const struct model_margin *margin, struct pace *pace,
                                         double *restitution, double *impulse)
{
    const struct problem *problem = margin->problem;
    const struct solution *solution = margin->solution;
    struct beside beside = {
        margin,
        {.problem = problem, .arena = problem->arena, .pace = pace, .work = solution->work},
        &solution->outcome,
        {0}};
    size_t n = problem->contact_count;
    struct distance spring = {0.0, arena_take(problem->arena, n, sizeof *spring.impulse)};
    struct distance flow = {0.0, arena_take(problem->arena, n, sizeof *flow.impulse)};
    if (!spring.impulse || !flow.impulse ||
        !fewer_modes(problem, solution->scene, &solution->outcome, FEWER_SEQUENCE, &beside.scene))
        return PERCUSS_INTERNAL;
    enum percuss_status status = PERCUSS_OK;
    /* by finite elements in the contact: the law's own answer to compare with */
    struct attempt base;
    if (by_finite_elements(problem)) {
        status = solve_beside(&beside, solution->scene, &base, &spring);
        spring.restitution = isinf(spring.restitution) ? INFINITY : 0.0;
        memset(spring.impulse, 0, n * sizeof *spring.impulse);
        beside.answer = &base.outcome;
    }
    /* with other stiffnesses, and where metal flows with other yield stresses */
    bool flows = false;
    for (size_t c = 0; c < n; c++)
        flows = flows || margin->deviation[c].yield > 0.0;
    if (!status)
        status = along(&beside, false, &spring);
    if (!status && flows && !isinf(spring.restitution))
        status = along(&beside, true, &flow);
    widen(problem, &spring, &flow, restitution, impulse);
    return status;
}
