/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/model_error.h"

#include <math.h>
#include <string.h>

#include "contact/plastic.h"
#include "impact/tangent.h"
#include "solve/attempt.h"
#include "solve/contact_model.h"
#include "solve/fewer.h"
#include "solve/law_error.h"
#include "solve/loss.h"
#include "solve/outcome.h"
#include "solve/validity.h"

/* Change of e by a unit of the stiffness's logarithm, of a single contact: by the share s of the
 * energy that vibrates, at most LOST s + SWUNG sqrt(s) of 97 in 100 random bars (waves that leave;
 * a mode that the contact catches in its swing). */
static const double LOST = 0.3;
static const double SWUNG = 0.2;
/* Longest steps of solutions beside a sequence, as accuracy (impact_settings), and of groups, whose
 * contacts open and close within steps: what they say of e is that of fine steps to 2 % of 7 in 8
 * random scenes. */
static const double LONGEST = 1e-3;
static const double LONGEST_GROUP = 1e-4;
/* Work that one of them may take, in those of the answer. */
static const double EFFORT = 3.0;
/* Change of a sub-impact's impulse up to which first order says what it makes of e: within a
 * quarter of what solutions beside say of 350 random sequences. */
static const double STRAIN = 0.05;
/* The same for what its slope and one solution beside say together: of 19 in 20 sequences no less
 * than 0.7 of what two solutions say. */
static const double STRAIN_CURVED = 0.5;
/* Expected change, by what is left out of the modes, from which on it is not followed: beyond it
 * half of the sequences are too sensitive for that. */
static const double HOPELESS = 0.7;
/* Between the answer and those beside it e need not lie between theirs. */
static const double BETWEEN = 1.5;

/* The contacts' deviations. */
struct margin {
    const struct problem *problem;
    const struct solution *solution;
    struct model_blow *blow;           /* [contact] */
    struct model_deviation *deviation; /* [contact] */
};

/* Of the stiffness, force and compliance together. */
static double stiffness_share(const struct margin *margin, size_t c)
{
    double by_compliance = margin->deviation[c].compliance * model_blow_stiffness(&margin->blow[c]);
    return hypot(margin->deviation[c].force, by_compliance);
}

/* Change of e by the stiffness's logarithm: by the speed it is known exactly for Hertz's law and
 * bodies that were at rest, twice that by the speed's (k d^1.5 at s times the speed is k sqrt(s)
 * d^1.5 at the same). */
static double sensitivity(const struct margin *margin)
{
    const struct impact_energy *energy = &margin->solution->outcome.energy;
    double by_speed = margin->solution->restitution_by_speed * margin->problem->gap_rate[0];
    bool hertz = !contact_model_used(margin->problem)->curve;
    if (hertz && isfinite(by_speed))
        return fabs(2.0 * by_speed);
    double share = (energy->vibration + energy->damping) / energy->available;
    share = fmin(fmax(share, 0.0), 1.0); /* NAN: nothing was available */
    return LOST * share + SWUNG * sqrt(share);
}

/* As if there were one contact after which the bodies part. */
static double single(const struct margin *margin)
{
    double largest = 0.0;
    for (size_t c = 0; c < margin->problem->contact_count; c++) {
        double spring = sensitivity(margin) * stiffness_share(margin, c);
        double flow = margin->deviation[c].yield *
                      outcome_rebound(margin->problem, &margin->solution->outcome, c);
        double ringing = model_deviation_ringing(margin->problem, c, &margin->blow[c]);
        largest = fmax(largest, hypot(hypot(spring, flow), ringing));
    }
    return largest + validity_wave_loss(margin->problem);
}

/* Which deviations a solution beside the answer has: all contacts softer or stiffer, every other
 * one so, or all yielding later or earlier. */
struct direction {
    bool alternate, flow;
    double sign;
};

/* What all of it together, stiffer, does to a single contact by first order along the answer. */
struct first_order {
    double restitution; /* change of e */
    double strain;      /* of a sub-impact's impulse; INFINITY: neither is known */
};

static enum percuss_status follow(const struct margin *margin, struct pace *pace,
                                  struct first_order *first)
{
    const struct solution *solution = margin->solution;
    const struct model_deviation *deviation = &margin->deviation[0];
    double all = stiffness_share(margin, 0);
    struct tangent tangent;
    *first = (struct first_order){INFINITY, INFINITY};
    bool hopeless = solution->modes.strained * sensitivity(margin) * all > HOPELESS;
    if (!solution->log || !(all > 0.0) || hopeless)
        return PERCUSS_OK;
    /* as deviate() has it */
    double other = deviation->compliance * model_blow_stiffness(&margin->blow[0]) / all;
    const struct tangent_source source = {.force = deviation->force / all * deviation->force,
                                          .compliance = -other * deviation->compliance};
    struct scene scene;
    if (!fewer_modes(margin->problem, solution->scene, &solution->outcome, FEWER_FIRST_ORDER,
                     &scene))
        return PERCUSS_INTERNAL;
    enum percuss_status status =
        tangent_follow(&scene, solution->log, &source, margin->problem->arena, pace, &tangent);
    if (!status)
        *first = (struct first_order){tangent.impulse / margin->problem->impulse_compression[0],
                                      tangent.strain};
    return status;
}

/* The point of the deviations where most of the stiffness changes: each by its own share of it. */
static void deviate(const struct margin *margin, const struct direction *direction, size_t c,
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
    double all = stiffness_share(margin, c);
    if (!(all > 0.0))
        return;
    double own = deviation->force / all;
    double other = deviation->compliance * model_blow_stiffness(&margin->blow[c]) / all;
    *law = contact_law_rescaled(law, exp(sign * own * deviation->force), 1.0);
    *compliance -= sign * other * deviation->compliance;
}

static bool make_scene(const struct margin *margin, const struct direction *direction,
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
    const struct margin *margin;
    struct attempt_context context;
    const struct impact_outcome *answer; /* that they are compared with */
    struct scene scene;                  /* that they deviate from */
};

/* Solves a scene, and how far its restitutions are from the answer's; INFINITY: nobody knows. */
static enum percuss_status solve_beside(struct beside *beside, const struct scene *scene,
                                        struct attempt *attempt, double *distance)
{
    const struct solution *solution = beside->margin->solution;
    double left = beside->context.work;
    double allowed = EFFORT * impact_work(solution->scene, &solution->outcome);
    *distance = INFINITY;
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
    if (!status && !attempt_is_spent(attempt) && !attempt->outcome.always_overlapped)
        *distance =
            outcome_compare(beside->margin->problem, beside->answer, &attempt->outcome).restitution;
    return status;
}

/* How far the other solution is from the answer: e on a parabola through both with the slope that
 * first order says. */
static double other_distance(const struct beside *beside, const struct first_order *first,
                             const struct attempt *softer)
{
    const struct problem *problem = beside->margin->problem;
    double change = outcome_restitution(problem, &softer->outcome, 0) -
                    outcome_restitution(problem, beside->answer, 0);
    return fabs(change + 2.0 * first->restitution);
}

/* The larger one of two distances along a direction and against it. */
static enum percuss_status along(struct beside *beside, bool flow, const struct first_order *first,
                                 double *largest)
{
    bool curved = !flow && first->strain <= STRAIN_CURVED;
    bool group = beside->margin->problem->contact_count > 1;
    for (int i = 0; i < 2 && !isinf(*largest); i++) {
        struct direction direction = {
            .alternate = group && i, .flow = flow, .sign = i && !group ? 1.0 : -1.0};
        struct scene scene = beside->scene;
        struct attempt attempt;
        double distance;
        if (!make_scene(beside->margin, &direction, &scene))
            return PERCUSS_INTERNAL;
        enum percuss_status status = solve_beside(beside, &scene, &attempt, &distance);
        if (status)
            return status;
        *largest = fmax(*largest, distance);
        if (curved && isfinite(distance)) {
            *largest = fmax(*largest, other_distance(beside, first, &attempt));
            return PERCUSS_OK;
        }
    }
    return PERCUSS_OK;
}

/* By solutions beside the answer. */
static enum percuss_status by_sequence(const struct margin *margin, const struct first_order *first,
                                       struct pace *pace, double *restitution)
{
    const struct problem *problem = margin->problem;
    const struct solution *solution = margin->solution;
    struct beside beside = {
        margin,
        {.problem = problem, .arena = problem->arena, .pace = pace, .work = solution->work},
        &solution->outcome,
        {0}};
    if (!fewer_modes(problem, solution->scene, &solution->outcome, FEWER_SEQUENCE, &beside.scene))
        return PERCUSS_INTERNAL;
    enum percuss_status status = PERCUSS_OK;
    double spring = 0.0;
    double flow = 0.0;
    /* by finite elements in the contact: the law's own answer to compare with */
    struct attempt base;
    if (by_finite_elements(problem)) {
        status = solve_beside(&beside, solution->scene, &base, &spring);
        spring = isinf(spring) ? spring : 0.0;
        beside.answer = &base.outcome;
    }
    /* with other stiffnesses, and where metal flows with other yield stresses */
    bool flows = false;
    for (size_t c = 0; c < problem->contact_count; c++)
        flows = flows || margin->deviation[c].yield > 0.0;
    if (!status)
        status = along(&beside, false, first, &spring);
    if (!status && flows && !isinf(spring))
        status = along(&beside, true, first, &flow);
    *restitution = fmax(*restitution, BETWEEN * hypot(spring, flow));
    return status;
}

static bool is_sequence(const struct margin *margin)
{
    const struct impact_outcome *outcome = &margin->solution->outcome;
    return margin->problem->contact_count > 1 || outcome->tracks[0].count > 1;
}

enum percuss_status model_error_find(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, double *restitution)
{
    /* what of each contact is uncertain */
    size_t n = problem->contact_count;
    struct margin margin = {
        .problem = problem,
        .solution = solution,
        .blow = arena_take(problem->arena, n, sizeof *margin.blow),
        .deviation = arena_take(problem->arena, n, sizeof *margin.deviation),
    };
    if (!margin.blow || !margin.deviation)
        return PERCUSS_INTERNAL;
    for (size_t c = 0; c < n; c++) {
        margin.blow[c] = model_blow_of(problem, &solution->outcome, c);
        margin.deviation[c] = model_deviation_of(problem, c, &margin.blow[c]);
    }
    /* as of one blow, and as sequences amplify it: by first order where that will do */
    enum percuss_status status = PERCUSS_OK;
    *restitution = single(&margin);
    if (is_sequence(&margin)) {
        struct first_order first;
        status = follow(&margin, pace, &first);
        if (!status && first.strain <= STRAIN)
            *restitution = fmax(*restitution, BETWEEN * fabs(first.restitution));
        else if (!status)
            status = by_sequence(&margin, &first, pace, restitution);
    }
    /* and what the materials lose of themselves */
    *restitution += loss_worst(problem, &solution->outcome);
    *restitution = fmin(*restitution, outcome_range(problem, &solution->outcome));
    return status;
}

double model_error_complete(const struct problem *problem, const struct model_blow *blow)
{
    double axes[2];
    double sum = 0.0;
    hertz_ellipse(&problem->hertz[0], blow->force, axes);
    for (int which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, 0, which);
        double ratio = axes[0] / body_smallest_radius(body);
        sum += (LOST + SWUNG) * MODEL_DEVIATION_PATCH * ratio * ratio;
        if (body_solid(body).approximate)
            sum += model_deviation_ringing(problem, 0, blow);
    }
    return sum;
}
