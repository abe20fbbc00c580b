/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/models.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/plastic.h"
#include "impact/sensitivity_group.h"
#include "solve/askew.h"
#include "solve/contact_model.h"
#include "solve/error/attempt.h"
#include "solve/error/calibration.h"
#include "solve/error/law.h"
#include "solve/outcome.h"
#include "solve/validity.h"

/* An answer, and the uncertain deviations of each of its contacts. */
struct model_margin {
    const struct problem *problem;
    const struct solution *solution;
    struct model_impact *impact; /* [contact] */
    struct deviation *deviation; /* [contact] */
};

/* ---- Perturbed solutions: contacts softer and stiffer, and yielding earlier and later ---- */

/* The deviations of a perturbed solution: all contacts softer or stiffer, every other one so, or
 * all yielding later or earlier. */
struct perturbation {
    bool alternate, flow;
    double sign;
};

static void deviate(const struct model_margin *margin, const struct perturbation *direction,
                    size_t c, struct contact_law *law, double *compliance)
{
    const struct deviation *deviation = &margin->deviation[c];
    double sign = direction->alternate && c % 2 ? -direction->sign : direction->sign;
    if (direction->flow) {
        double depth = margin->impact[c].history.max_indentation;
        if (!(deviation->yield > 0.0 && law->operations->curve))
            return;
        double yield = law_error_yield(law, depth, deviation->yield);
        *law = contact_law_rescaled(law, 1.0, sign > 0.0 ? yield : 1.0 / yield);
        return;
    }
    struct stiffening stiffer = deviation_stiffening(deviation, &margin->impact[c]);
    *law = contact_law_rescaled(law, exp(sign * stiffer.force), 1.0);
    *compliance += sign * stiffer.compliance;
}

static bool make_scene(const struct model_margin *margin, const struct perturbation *direction,
                       struct scene *scene)
{
    size_t n = margin->problem->contact_count;
    struct arena *arena = margin->problem->arena;
    struct contact_law *laws = arena_take(arena, n, sizeof *laws);
    size_t rows = scene->rows;
    double *residual = arena_take(arena, rows * rows, sizeof *residual);
    if (!laws || !residual)
        return false;
    memcpy(laws, scene->laws, n * sizeof *laws);
    memcpy(residual, scene->residual, rows * rows * sizeof *residual);
    for (size_t c = 0; c < n; c++)
        deviate(margin, direction, c, &laws[c], &residual[c * rows + c]);
    scene->laws = laws;
    scene->residual = residual;
    return true;
}

static bool by_finite_elements(const struct problem *problem)
{
    enum percuss_contact_model asked = problem->request->options.contact_model;
    return contact_law_asked(asked)->method == CONTACT_CONCURRENT;
}

/* The perturbed solutions of an answer, which share the effort. */
struct perturbed {
    const struct model_margin *margin;
    struct attempt_context context;
    const struct impact_outcome *answer; /* that they are compared with */
    struct scene scene;                  /* that they deviate from */
};

/* Distance of solutions from the answer; INFINITY: unknown. */
struct distance {
    double restitution; /* largest of a contact */
    double *impulse;    /* [contact], N s */
};

/* Solves a scene, and widens the distance to its own. */
static enum percuss_status solve_perturbed(struct perturbed *perturbed, const struct scene *scene,
                                           struct attempt *attempt, struct distance *distance)
{
    const struct solution *solution = perturbed->margin->solution;
    double left = perturbed->context.work;
    double allowed = PERTURBED_WORK * impact_work(solution->scene, &solution->outcome);
    double before = distance->restitution;
    distance->restitution = INFINITY;
    if (solution->spent || solution->outcome.end_reason == PERCUSS_END_LIMIT)
        return PERCUSS_OK;
    /* no more than a few times the answer's own effort, where that is of the same kind */
    allowed = by_finite_elements(perturbed->margin->problem) ? left : smaller(left, allowed);
    bool modal = perturbed->margin->problem->request->options.method == PERCUSS_METHOD_MODAL;
    double longest = scene->contacts > 1 ? PERTURBED_STEPS_GROUP : PERTURBED_STEPS;
    *attempt = (struct attempt){.accuracy = larger(solution->step_accuracy, modal ? longest : 0.0),
                                .assembly = solution->assembly,
                                .profile = STEP_PROFILE_ROUGH};
    perturbed->context.work = allowed;
    enum percuss_status status = attempt_run(&perturbed->context, attempt, scene);
    perturbed->context.work += left - allowed;
    if (status || attempt_is_spent(attempt) || attempt->outcome.always_overlapped)
        return status;
    const struct problem *problem = perturbed->margin->problem;
    distance->restitution =
        larger(outcome_compare(problem, perturbed->answer, &attempt->outcome).restitution, before);
    outcome_widen_impulses(problem, perturbed->answer, &attempt->outcome, distance->impulse);
    return PERCUSS_OK;
}

/* The larger one of two distances along a direction and against it. */
static enum percuss_status along(struct perturbed *perturbed, bool flow, struct distance *largest)
{
    bool group = perturbed->margin->problem->contact_count > 1;
    for (int i = 0; i < 2 && !isinf(largest->restitution); i++) {
        struct perturbation direction = {
            .alternate = group && i, .flow = flow, .sign = i && !group ? 1.0 : -1.0};
        struct scene scene = perturbed->scene;
        struct attempt attempt;
        if (!make_scene(perturbed->margin, &direction, &scene))
            return PERCUSS_INTERNAL;
        enum percuss_status status = solve_perturbed(perturbed, &scene, &attempt, largest);
        if (status)
            return status;
    }
    return PERCUSS_OK;
}

static void widen(const struct problem *problem, const struct distance *spring,
                  const struct distance *flow, double *restitution, double *impulse)
{
    double both = hypot(spring->restitution, flow->restitution);
    *restitution = larger(BETWEEN * both, *restitution);
    for (size_t c = 0; c < problem->contact_count; c++) {
        double change = isinf(both) ? INFINITY : hypot(spring->impulse[c], flow->impulse[c]);
        impulse[c] = larger(BETWEEN * change, impulse[c]);
    }
}

/* Widens the error of e, and those of the contacts' impulses (N s), to the distance of the farthest
 * perturbed solution. INFINITY: unknown. */
static enum percuss_status find_perturbed(const struct model_margin *margin, struct pace *pace,
                                          double *restitution, double *impulse)
{
    const struct problem *problem = margin->problem;
    const struct solution *solution = margin->solution;
    struct perturbed perturbed = {
        margin,
        {.problem = problem, .arena = problem->arena, .pace = pace, .work = solution->work},
        &solution->outcome,
        {0}};
    size_t n = problem->contact_count;
    struct distance spring = {0.0, arena_take(problem->arena, n, sizeof *spring.impulse)};
    struct distance flow = {0.0, arena_take(problem->arena, n, sizeof *flow.impulse)};
    if (!spring.impulse || !flow.impulse ||
        !attempt_truncate(problem, solution->scene, &solution->outcome, MOST_MODES_SEQUENCE,
                          &perturbed.scene))
        return PERCUSS_INTERNAL;
    enum percuss_status status = PERCUSS_OK;
    /* by finite elements in the contact: the law's own answer to compare with */
    struct attempt base;
    if (by_finite_elements(problem)) {
        status = solve_perturbed(&perturbed, solution->scene, &base, &spring);
        spring.restitution = isinf(spring.restitution) ? INFINITY : 0.0;
        memset(spring.impulse, 0, n * sizeof *spring.impulse);
        perturbed.answer = &base.outcome;
    }
    /* with other stiffnesses, and where metal flows with other yield stresses */
    bool flows = false;
    for (size_t c = 0; c < n; c++)
        flows = flows || margin->deviation[c].yield > 0.0;
    if (!status)
        status = along(&perturbed, false, &spring);
    if (!status && flows && !isinf(spring.restitution))
        status = along(&perturbed, true, &flow);
    widen(problem, &spring, &flow, restitution, impulse);
    return status;
}

/* ---- The models' error ---- */

/* Change of e by the stiffness's logarithm: by the speed it is known exactly for Hertz's law and
 * bodies that were at rest, twice that by the speed's (k d^1.5 at s times the speed is k sqrt(s)
 * d^1.5 at the same). */
static double sensitivity(const struct model_margin *margin)
{
    const struct impact_energy *energy = &margin->solution->outcome.energy;
    double by_speed = margin->solution->restitution_by_speed * margin->problem->gap_rate[0];
    bool hertz = !contact_model_used(margin->problem)->curve;
    if (hertz && isfinite(by_speed))
        return fabs(2.0 * by_speed);
    /* what the contact itself loses hardly depends on its stiffness */
    double relaxed = margin->solution->outcome.relaxed;
    double share = (energy->vibration + energy->damping - relaxed) / energy->available;
    share = smaller(larger(share, 0.0), 1.0); /* NAN: nothing was available */
    return LOST * share + SWUNG * sqrt(share);
}

/* The parts of the error of a contact, as changes of its e. */

static double by_stiffness(const struct model_margin *margin, size_t c)
{
    return sensitivity(margin) * deviation_stiffness(&margin->deviation[c], &margin->impact[c]);
}

static double by_flow(const struct model_margin *margin, size_t c)
{
    return margin->deviation[c].yield *
           outcome_rebound(margin->problem, &margin->solution->outcome, c);
}

static double by_loss(const struct model_margin *margin, size_t c)
{
    return loss_deviation(margin->problem, c,
                          outcome_rebound(margin->problem, &margin->solution->outcome, c));
}

static double by_ringing(const struct model_margin *margin, size_t c)
{
    return deviation_ringing(margin->problem, c, &margin->impact[c]);
}

static double by_askew_bars(const struct model_margin *margin, size_t c)
{
    return askew_loss(margin->problem, c, margin->impact[c].duration);
}

/* By the energy that goes into waves of a bar's whole body. */
static double by_waves(const struct model_margin *margin, size_t c)
{
    const struct problem *problem = margin->problem;
    const struct impact_outcome *outcome = &margin->solution->outcome;
    double compression = problem->impulse_compression[c];
    double lost =
        deviation_waves(problem, margin->solution->assembly, outcome, c, &margin->impact[c]);
    if (!(compression > 0.0) || lost == 0.0)
        return 0.0;
    double rebound = larger(fabs(outcome_restitution(problem, outcome, c)), LEAST_REBOUND);
    double w = problem->w[c * (problem->contact_count + 1)];
    return lost / (rebound * compression * compression * w);
}

/* In this order. Independent parts add by squares; those that the models lack altogether add. */
static const struct part {
    const char *name;
    double (*of_contact)(const struct model_margin *margin, size_t c);
    bool independent;
} PARTS[] = {
    {"stiffness of the contact", by_stiffness, true},
    {"flow of the metal", by_flow, true},
    {"loss of the materials", by_loss, true},
    {"ringing of bodies taken as rigid", by_ringing, true},
    {"bars hit askew", by_askew_bars, false},
    {"waves that no mode has", by_waves, false},
};

static double of_contact(const struct model_margin *margin, size_t c)
{
    double sum = 0.0;
    for (size_t i = 0; i < sizeof PARTS / sizeof *PARTS; i++) {
        double part = PARTS[i].of_contact(margin, c);
        sum = PARTS[i].independent ? hypot(sum, part) : sum + part;
    }
    return sum;
}

/* As if there were one contact after which the bodies part. */
static void single(const struct model_margin *margin, struct model_error *error)
{
    const struct impact_outcome *outcome = &margin->solution->outcome;
    double waves = validity_wave_loss(margin->problem);
    error->restitution = 0.0;
    for (size_t c = 0; c < margin->problem->contact_count; c++) {
        double change = of_contact(margin, c);
        error->restitution = larger(change, error->restitution);
        error->impulse[c] = (change + waves) * outcome_impulse_scale(margin->problem, outcome, c);
    }
    error->restitution += waves;
}

/* All deviations of a contact's stiffness together, as they make it stiffer or softer. */
static struct sensitivity_source source_of(const struct model_margin *margin, size_t c, double sign)
{
    const struct deviation *deviation = &margin->deviation[c];
    struct stiffening stiffer = deviation_stiffening(deviation, &margin->impact[c]);
    return (struct sensitivity_source){.force = sign * stiffer.force,
                                       .compliance = sign * stiffer.compliance};
}

/* Effect of all deviations together, stiffer, by the orders along the answer. */
struct by_orders {
    double first, second;                 /* derivatives of e */
    double strain;                        /* of a sub-impact's impulse; INFINITY: none is known */
    double impulse[PERCUSS_MAX_CONTACTS]; /* derivatives of each, of a group */
};

/* Of several contacts, all of them stiffer, and every other one: the larger change. */
static enum percuss_status follow_group(const struct model_margin *margin, struct pace *pace,
                                        struct by_orders *orders)
{
    const struct problem *problem = margin->problem;
    const struct solution *solution = margin->solution;
    struct sensitivity_source source[2][PERCUSS_MAX_CONTACTS];
    struct sensitivity_group tangent[2];
    struct scene scene;
    for (size_t c = 0; c < problem->contact_count; c++) {
        source[0][c] = source_of(margin, c, 1.0);
        source[1][c] = source_of(margin, c, c % 2 ? -1.0 : 1.0);
    }
    if (!attempt_followed_scene(problem, solution->scene, &solution->outcome, &scene))
        return PERCUSS_INTERNAL;
    const struct sensitivity_group_task task = {&scene, solution->log, 2, {source[0], source[1]}};
    enum percuss_status status = sensitivity_group_follow(&task, problem->arena, pace, tangent);
    if (status)
        return status;
    orders->first = orders->second = 0.0;
    orders->strain = fmax(tangent[0].strain, tangent[1].strain);
    for (size_t c = 0; c < problem->contact_count; c++) {
        double compression = problem->impulse_compression[c];
        double change = fmax(fabs(tangent[0].impulse[c]), fabs(tangent[1].impulse[c]));
        orders->impulse[c] = change;
        if (compression > 0.0)
            orders->first = larger(change / compression, orders->first);
    }
    return PERCUSS_OK;
}

/* Along the answer, as the search for modes left it or made now. NULL: out of memory. */
static struct sensitivity_path *find_path(const struct model_margin *margin)
{
    const struct solution *solution = margin->solution;
    struct scene scene;
    if (solution->path)
        return solution->path;
    if (!attempt_followed_scene(margin->problem, solution->scene, &solution->outcome, &scene))
        return NULL;
    return sensitivity_path_create(&scene, solution->log, margin->problem->arena);
}

static enum percuss_status follow(const struct model_margin *margin, struct sensitivity_path *path,
                                  bool curved, struct pace *pace, struct by_orders *orders)
{
    struct sensitivity_source source = source_of(margin, 0, 1.0);
    struct sensitivity tangent;
    source.curved = curved;
    enum percuss_status status = sensitivity_follow(path, &source, pace, &tangent);
    double compression = margin->problem->impulse_compression[0];
    if (status)
        return status;
    orders->first = tangent.impulse / compression;
    orders->second = tangent.curvature / compression;
    orders->strain = tangent.strain;
    return PERCUSS_OK;
}

/* Of a single contact: second order at once where the effect of the omitted modes lets expect that
 * first order is not enough. */
static enum percuss_status single_by_order(const struct model_margin *margin, struct pace *pace,
                                           struct by_orders *orders, double *change)
{
    const struct solution *solution = margin->solution;
    double all = deviation_stiffness(&margin->deviation[0], &margin->impact[0]);
    double expected = solution->error.modes.strained * sensitivity(margin) * all;
    if (!(all > 0.0))
        return PERCUSS_OK;
    bool bends = solution->scene->laws[0].operations->three_halves;
    bool curved = bends && expected > STRAIN_MODELS;
    struct sensitivity_path *path = find_path(margin);
    enum percuss_status status = follow(margin, path, curved, pace, orders);
    if (!status && !curved && bends && orders->strain > STRAIN_MODELS &&
        orders->strain <= STRAIN_MODELS_CURVED) {
        curved = true;
        status = follow(margin, path, curved, pace, orders);
    }
    if (!status && orders->strain <= (curved ? STRAIN_MODELS_CURVED : STRAIN_MODELS))
        *change = fabs(orders->first) + 0.5 * fabs(orders->second);
    return status;
}

/* Change of e, where first or second order tells it; INFINITY: neither does. */
static enum percuss_status by_order(const struct model_margin *margin, struct pace *pace,
                                    struct by_orders *orders, double *change)
{
    *change = INFINITY;
    if (!margin->solution->log)
        return PERCUSS_OK;
    if (margin->problem->contact_count == 1)
        return single_by_order(margin, pace, orders, change);
    enum percuss_status status = follow_group(margin, pace, orders);
    if (!status && orders->strain <= STRAIN_MODELS_GROUP)
        *change = orders->first;
    return status;
}

static bool is_sequence(const struct model_margin *margin)
{
    const struct impact_outcome *outcome = &margin->solution->outcome;
    return margin->problem->contact_count > 1 || outcome->tracks[0].count > 1;
}

/* As sequences amplify it: along the answer where that will do. */
static enum percuss_status amplify(const struct model_margin *margin, struct pace *pace,
                                   struct model_error *error)
{
    struct by_orders orders;
    double change;
    enum percuss_status status = by_order(margin, pace, &orders, &change);
    if (status)
        return status;
    if (!isfinite(change))
        return find_perturbed(margin, pace, &error->restitution, error->impulse);
    error->restitution = larger(BETWEEN * change, error->restitution);
    for (size_t c = 0; margin->problem->contact_count > 1 && c < margin->problem->contact_count;
         c++)
        error->impulse[c] = larger(BETWEEN * orders.impulse[c], error->impulse[c]);
    return PERCUSS_OK;
}

/* ---- Coefficients of friction ---- */

/* A deviation takes no more of a coefficient. */
static const double LEAST_COEFFICIENT = 0.01;

static bool coefficients_are_exact(const struct problem *problem)
{
    for (size_t i = 0; i < problem->friction_count; i++)
        if (problem->friction[i].deviation > 0.0)
            return false;
    return true;
}

/* Of the steps of solutions with other coefficients: rough ones, where a deviation's effect is
 * large enough. */
static double friction_accuracy(const struct model_margin *margin)
{
    const struct problem *problem = margin->problem;
    double root = sqrt(PERTURBED_STEPS);
    for (size_t i = 0; i < problem->friction_count; i++) {
        const struct contact_friction *of = &problem->friction[i];
        if (of->deviation > 0.0)
            root = smaller(root, PERTURBED_FRICTION * of->deviation / of->coefficient);
    }
    return larger(root * root, margin->solution->step_accuracy);
}

/* Solves roughly with all coefficients so many deviations larger. */
static enum percuss_status solve_coefficients(const struct model_margin *margin,
                                              struct attempt_context *context, double sign,
                                              struct attempt *attempt)
{
    const struct problem *problem = margin->problem;
    struct scene scene = *margin->solution->scene;
    struct scene_friction *friction = arena_take(problem->arena, scene.frictions, sizeof *friction);
    if (!friction)
        return PERCUSS_INTERNAL;
    for (size_t i = 0; i < scene.frictions; i++) {
        const struct contact_friction *of = &problem->friction[i];
        friction[i] = scene.friction[i];
        friction[i].coefficient =
            larger(of->coefficient + sign * of->deviation, LEAST_COEFFICIENT * of->coefficient);
    }
    scene.friction = friction;
    *attempt = (struct attempt){.accuracy = friction_accuracy(margin),
                                .assembly = margin->solution->assembly,
                                .profile = STEP_PROFILE_ROUGH};
    return attempt_run(context, attempt, &scene);
}

/* Widens the tangential impulses' errors and those that a coefficient's deviation makes of the
 * normal ones, N s, to the distance of another solution from the answer. */
static void widen_by_friction(const struct problem *problem, const struct impact_outcome *answer,
                              const struct impact_outcome *other, double *tangential,
                              double *impulse)
{
    for (size_t i = 0; i < problem->friction_count; i++) {
        size_t c = problem->friction[i].contact;
        tangential[c] = larger(outcome_tangential_change(answer, other, c), tangential[c]);
    }
    outcome_widen_impulses(problem, answer, other, impulse);
}

static void unknown_by_friction(const struct problem *problem, struct model_error *error)
{
    error->friction = INFINITY;
    for (size_t i = 0; i < problem->friction_count; i++)
        error->tangential[problem->friction[i].contact] = INFINITY;
}

/* The changes of e and of the tangential impulses by coefficients that are a deviation smaller,
 * from the answer; INFINITY where a solution was cut off. What its rough steps leave is little
 * beside the deviation's effect, also in sequences. A tangential impulse grows with the coefficient
 * up to a largest one: of 300 throws on the paper's beam larger coefficients changed it by less
 * than half as much as smaller ones in 39, by more than twice as much in 10. A sequence amplifies
 * the deviation, too, unless friction is weak (the answer's forces were recorded): then
 * coefficients are larger as well. */
static enum percuss_status by_friction(const struct model_margin *margin, struct pace *pace,
                                       struct model_error *error)
{
    const struct problem *problem = margin->problem;
    const struct solution *solution = margin->solution;
    struct attempt_context context = {
        .problem = problem, .arena = problem->arena, .pace = pace, .work = solution->work};
    double *impulse = arena_take(problem->arena, problem->contact_count, sizeof *impulse);
    static const double deviations[] = {-1.0, 1.0};
    size_t count = is_sequence(margin) && !solution->log ? 2 : 1;
    if (!impulse)
        return PERCUSS_INTERNAL;
    for (size_t i = 0; i < count; i++) {
        struct attempt other;
        enum percuss_status status = solve_coefficients(margin, &context, deviations[i], &other);
        if (status)
            return status;
        if (attempt_is_spent(&other)) {
            unknown_by_friction(problem, error);
            return PERCUSS_OK;
        }
        widen_by_friction(problem, &solution->outcome, &other.outcome, error->tangential, impulse);
    }
    for (size_t c = 0; c < problem->contact_count; c++) {
        error->impulse[c] = hypot(error->impulse[c], impulse[c]);
        if (problem->impulse_compression[c] > 0.0)
            error->friction = larger(impulse[c] / problem->impulse_compression[c], error->friction);
    }
    return PERCUSS_OK;
}

enum percuss_status models_find_error(const struct problem *problem,
                                      const struct solution *solution, struct pace *pace,
                                      struct model_error *error)
{
    /* the deviations of each contact */
    size_t n = problem->contact_count;
    struct model_margin margin = {
        .problem = problem,
        .solution = solution,
        .impact = arena_take(problem->arena, n, sizeof *margin.impact),
        .deviation = arena_take(problem->arena, n, sizeof *margin.deviation),
    };
    error->impulse = arena_take(problem->arena, 2 * n, sizeof *error->impulse);
    if (!margin.impact || !margin.deviation || !error->impulse)
        return PERCUSS_INTERNAL;
    error->tangential = error->impulse + n;
    for (size_t c = 0; c < n; c++) {
        margin.impact[c] = model_impact_of(problem, &solution->outcome, c);
        margin.deviation[c] = deviation_of(problem, c, &margin.impact[c]);
    }
    /* as of one impact, and of a sequence of them */
    enum percuss_status status = PERCUSS_OK;
    single(&margin, error);
    if (is_sequence(&margin))
        status = amplify(&margin, pace, error);
    if (!status && !coefficients_are_exact(problem))
        status = by_friction(&margin, pace, error);
    error->restitution = hypot(error->restitution, error->friction);
    /* losses of the materials themselves, and of metals of unstated yield */
    double loss = loss_worst(problem, &solution->outcome);
    double yield = unstated_worst(problem, &solution->outcome);
    double range = outcome_range(problem, &solution->outcome);
    double elastic = smaller(error->restitution + loss, range);
    error->restitution = smaller(error->restitution + loss + yield, range);
    error->yield = error->restitution - elastic;
    for (size_t c = 0; c < n; c++)
        error->impulse[c] += (loss + yield) * outcome_impulse_scale(problem, &solution->outcome, c);
    return status;
}

double models_complete_error(const struct problem *problem, const struct model_impact *impact)
{
    double axes[2];
    double sum = 0.0;
    hertz_ellipse(&problem->hertz[0], impact->force, axes);
    for (int which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, 0, which);
        double ratio = axes[0] / body_smallest_radius(body);
        sum += (LOST + SWUNG) * PATCH * ratio * ratio;
        if (body_solid(body).approximate)
            sum += deviation_ringing(problem, 0, impact);
    }
    return sum;
}
