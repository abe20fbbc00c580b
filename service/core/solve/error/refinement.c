/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/refinement.h"

#include <math.h>

#include "base/extremes.h"
#include "impact/sensitivity.h"
#include "solve/assemble.h"
#include "solve/error/calibration.h"
#include "solve/error/neighbours.h"
#include "solve/mode_choice.h"

/* ---- The error of the modes of a sequence ---- */

/* A sequence that is compared with other solutions, and their results so far. */
struct comparison {
    struct attempt_context *context;
    struct attempt *best;
    struct mode_error *error;
    struct mode_error slow;       /* to first order of one impact, before any comparison */
    bool first;                   /* there was no other solution before */
    bool fixed;                   /* the catalogue fixes fewer modes than the better model has */
    bool is_long, is_struck;      /* one comparison may agree by chance */
    bool decided;                 /* no further estimator is asked */
    bool agrees;                  /* with the better model and longer steps */
    struct scene better;          /* the next better model, once `both` was solved */
    struct attempt unfixed, both; /* with that model; with longer steps as well */
    struct outcome_difference by_both; /* to that one */
};

static void widen_modes(struct mode_error *error, double factor, struct outcome_difference change)
{
    error->restitution = larger(factor * change.restitution, error->restitution);
    error->impulse = larger(factor * change.impulse, error->impulse);
}

static bool is_unchecked(const struct comparison *comparison)
{
    return comparison->error->verdict == MODES_UNCHECKED;
}

static bool fits_share(const struct comparison *comparison, double share)
{
    return comparison->error->restitution <= share * comparison->context->problem->tolerance;
}

/* Solves another scene of the same contacts, or the same with other steps. A solution that was cut
 * off says nothing: then the error stays unchecked, and the comparison ends. */
static enum percuss_status solve_other(struct comparison *comparison, const struct scene *scene,
                                       struct attempt *other)
{
    struct attempt_context *context = comparison->context;
    struct impact_outcome *answer = &comparison->best->outcome;
    attempt_by_other_means(other);
    enum percuss_status status = attempt_run(context, other, scene);
    if (status)
        return status;
    answer->too_stiff = answer->too_stiff || other->outcome.too_stiff;
    if (attempt_is_spent(other)) {
        comparison->error->verdict = MODES_UNCHECKED;
        comparison->decided = true;
    } else {
        neighbours_add(context->neighbours, context->problem, &other->outcome);
    }
    return PERCUSS_OK;
}

static void widen_by(struct comparison *comparison, double factor, const struct attempt *other)
{
    if (!is_unchecked(comparison))
        widen_modes(comparison->error, factor,
                    outcome_compare(comparison->context->problem, &comparison->best->outcome,
                                    &other->outcome));
}

/* Where the catalogue fixes numbers of modes, with as many as leave out a tenth of the answer's
 * own first-order effect, or as few as the tolerance asks for; not by CVODE, as its effort goes
 * with the highest frequency. */
static enum percuss_status find_unfixed(struct comparison *comparison)
{
    const struct problem *problem = comparison->context->problem;
    struct attempt *unfixed = &comparison->unfixed;
    bool fixed = false;
    *unfixed = *comparison->best;
    for (size_t b = 0; b < problem->body_count; b++)
        fixed = fixed || problem->bodies[b]->modes > 0;
    if (!fixed || problem->request->options.method == PERCUSS_METHOD_CVODE)
        return PERCUSS_OK;
    double most = problem->contact_count > 1 ? MOST_MODES_GROUP : MOST_MODES_SEQUENCE;
    double allowed = smaller(comparison->slow.restitution / FEWER_MODES, most);
    unfixed->choice.unfixed = true;
    unfixed->choice.allowed = larger(unfixed->choice.allowed, allowed);
    enum percuss_status status = attempt_assemble(comparison->context, unfixed);
    comparison->fixed =
        !status && !assembly_same_modes(unfixed->assembly, comparison->best->assembly);
    return status;
}

/* Whether first order is asked: steps of the first accuracy leave little of the tolerance (of a
 * group at times a hundred times the modes' effect, which other steps alone tell), and the bodies
 * do not ring already, when forces would not be slow. */
static bool first_order_applies(const struct comparison *comparison)
{
    const struct attempt_context *context = comparison->context;
    for (size_t b = 0; b < context->problem->body_count; b++)
        if (context->problem->states[b])
            return false;
    double tolerance = context->problem->tolerance;
    bool fine = comparison->best->accuracy <= attempt_first_accuracy(tolerance, true, false);
    return !comparison->fixed && comparison->first && context->problem->contact_count == 1 &&
           attempt_is_followed(context, comparison->best) &&
           (tolerance >= TOLERANCE_FOLLOWED || (fine && tolerance >= TOLERANCE_FOLLOWED_FINE));
}

/* Follows the inertia and viscosity of the omitted modes along the answer, with fewer modes. */
static enum percuss_status follow_omitted(struct attempt_context *context, struct attempt *best,
                                          struct sensitivity *tangent)
{
    struct scene scene;
    const struct omitted *omitted = &best->assembly->omitted[0];
    const struct sensitivity_source source = {.viscosity = omitted->viscosity,
                                              .inertia = omitted->inertia};
    if (!attempt_followed_scene(context->problem, &best->assembly->scene, &best->outcome, &scene))
        return PERCUSS_INTERNAL;
    best->path = sensitivity_path_create(&scene, best->log, context->arena);
    return sensitivity_follow(best->path, &source, context->pace, tangent);
}

/* First order's error of the bodies' vibration, which is wrong by as much more as the impulse is:
 * by steps, too. */
static void find_vibration(struct attempt_context *context, const struct attempt *best,
                           const struct sensitivity *tangent, double more)
{
    double *vibration = context->neighbours->vibration;
    for (size_t b = 0; b < context->problem->body_count; b++)
        vibration[b] =
            larger(more * more * sensitivity_vibration(best->path, tangent, b), vibration[b]);
}

/* Decides unless it amplifies too much, or steps alone spend the tolerance. */
static enum percuss_status by_first_order(struct comparison *comparison)
{
    struct attempt_context *context = comparison->context;
    struct mode_error *error = comparison->error;
    struct sensitivity tangent;
    enum percuss_status status = follow_omitted(context, comparison->best, &tangent);
    if (status)
        return status;
    double slow = error->restitution;
    double compression = problem_largest_compression(context->problem);
    double change = tangent.largest / compression;
    double tolerance = context->problem->tolerance;
    error->strained = tangent.strain / slow;
    if (!(tangent.strain <= STRAIN_MODES) || change > STRONG * larger(slow, NEGLIGIBLE * tolerance))
        return PERCUSS_OK;
    /* the steps' part of one impact is amplified alike */
    double modes = FACTOR_FIRST_ORDER * change;
    double left = attempt_steps_leave(comparison->best->accuracy);
    double steps = larger(left * larger(change / slow, 1.0), STRAY);
    double allowed = SHARE_BOTH * tolerance;
    double both = hypot(modes, steps); /* they are independent */
    if (modes <= allowed && both > allowed)
        return PERCUSS_OK;
    comparison->decided = true;
    error->restitution = both;
    error->impulse = error->restitution * compression;
    error->verdict = modes <= allowed ? MODES_AND_STEPS : MODES_ALONE;
    if (change > 0.0)
        find_vibration(context, comparison->best, &tangent, hypot(change, steps) / change);
    return PERCUSS_OK;
}

static bool always_applies(const struct comparison *comparison)
{
    (void)comparison;
    return true;
}

/* Whether a contact of a group gets much of its impulse by way of others, or has little of its own:
 * the error of the others' forces by steps is large there, and one comparison may agree by chance.
 */
static bool is_struck_by_others(const struct problem *problem, const struct attempt *best)
{
    size_t n = problem->contact_count;
    double slight = NEGLIGIBLE * problem_largest_compression(problem);
    for (size_t c = 0; n > 1 && c < n; c++)
        if (outcome_restitution(problem, &best->outcome, c) > STRUCK ||
            (problem->impulse_compression[c] > 0.0 && problem->impulse_compression[c] < slight))
            return true;
    return false;
}

/* A better model with longer steps: good where the answer agrees with it and that is no chance. */
static enum percuss_status by_model_and_steps(struct comparison *comparison)
{
    const struct attempt_context *context = comparison->context;
    const struct problem *problem = context->problem;
    struct attempt *best = comparison->best;
    struct mode_error *error = comparison->error;
    comparison->both = *best;
    comparison->both.accuracy *= LONGER_STEPS;
    comparison->better = comparison->unfixed.assembly->scene;
    if (!comparison->fixed && !assemble_remainder(best->assembly, problem, &comparison->better))
        return PERCUSS_INTERNAL;
    enum percuss_status status = solve_other(comparison, &comparison->better, &comparison->both);
    if (status || comparison->decided)
        return status;
    const struct outcome_difference change =
        outcome_compare(problem, &best->outcome, &comparison->both.outcome);
    double slow = comparison->slow.restitution;
    comparison->is_long =
        attempt_is_long(best) ||
        change.restitution > STRONG * larger(slow, NEGLIGIBLE * problem->tolerance);
    comparison->is_struck = is_struck_by_others(problem, best);
    comparison->slow.strained = error->strained = change.restitution / slow;
    widen_modes(error, FACTOR_COMPARED, change);
    comparison->agrees =
        comparison->first && !comparison->is_long && fits_share(comparison, SHARE_BOTH);
    if (comparison->agrees && !comparison->is_struck) {
        error->verdict = MODES_AND_STEPS;
        comparison->decided = true;
    }
    return PERCUSS_OK;
}

/* The better model with the answer's own steps. */
static enum percuss_status by_model(struct comparison *comparison)
{
    struct attempt next = *comparison->best;
    enum percuss_status status = solve_other(comparison, &comparison->better, &next);
    if (!status)
        widen_by(comparison, FACTOR_COMPARED, &next);
    return status;
}

static bool agreed_though_struck(const struct comparison *comparison)
{
    return comparison->agrees && comparison->is_struck;
}

/* Of a contact that others strike the agreement may be chance: the better model's own steps tell.
 */
static enum percuss_status by_model_of_struck(struct comparison *comparison)
{
    enum percuss_status status = by_model(comparison);
    if (!status && !comparison->decided && fits_share(comparison, SHARE_BOTH)) {
        comparison->error->verdict = MODES_AND_STEPS;
        comparison->decided = true;
    }
    return status;
}

/* Which of the two differences of `both` is large, that of the model or that of the steps: the same
 * model with longer steps. */
static enum percuss_status by_steps(struct comparison *comparison)
{
    struct attempt_context *context = comparison->context;
    struct attempt *best = comparison->best;
    struct mode_error *error = comparison->error;
    struct attempt *longer = arena_take(context->arena, 1, sizeof *longer);
    if (!longer)
        return PERCUSS_INTERNAL;
    *error = comparison->slow;
    *longer = *best;
    longer->accuracy = comparison->both.accuracy;
    enum percuss_status status = solve_other(comparison, &best->assembly->scene, longer);
    if (status || comparison->decided)
        return status;
    /* the steps' part of the difference, and the model's */
    double steps = FACTOR_COMPARED *
                   outcome_compare(context->problem, &best->outcome, &longer->outcome).restitution;
    widen_modes(error, FACTOR_COMPARED,
                outcome_compare(context->problem, &longer->outcome, &comparison->both.outcome));
    error->longer = longer;
    /* whichever is further from its share */
    double allowed = SHARE_STEPS * context->problem->tolerance;
    double modes = SHARE_STEPS / SHARE_MODES * error->restitution;
    if (steps > larger(allowed, modes))
        error->verdict = MODES_BELOW_STEPS;
    comparison->decided =
        error->verdict == MODES_BELOW_STEPS || !fits_share(comparison, SHARE_MODES);
    return PERCUSS_OK;
}

static bool may_agree_again(const struct comparison *comparison)
{
    return (comparison->is_long || comparison->is_struck) && fits_share(comparison, SHARE_MODES);
}

/* One more solution of a long sequence, with fewer modes; none where there are none to leave out:
 * those that a state or the catalogue demands. */
static enum percuss_status by_fewer_modes(struct comparison *comparison)
{
    struct attempt fewer = *comparison->best;
    fewer.choice.allowed *= FEWER_MODES;
    enum percuss_status status = attempt_assemble(comparison->context, &fewer);
    if (status || assembly_same_modes(fewer.assembly, comparison->best->assembly))
        return status;
    status = solve_other(comparison, &fewer.assembly->scene, &fewer);
    if (!status)
        widen_by(comparison, FACTOR_FEWER, &fewer);
    return status;
}

/* In this order, until one of them decides. Where first order does not say the error, the first
 * other solution has the next better model and longer steps at once: most answers agree with it.
 * The others tell its two differences apart, and chance from agreement. */
static const struct estimator {
    const char *name;
    bool (*applies)(const struct comparison *comparison);
    enum percuss_status (*estimate)(struct comparison *comparison);
} ESTIMATORS[] = {
    {"first order along the answer", first_order_applies, by_first_order},
    {"better model, longer steps", always_applies, by_model_and_steps},
    {"better model, of a contact that others strike", agreed_though_struck, by_model_of_struck},
    {"longer steps", always_applies, by_steps},
    {"better model", always_applies, by_model},
    {"fewer modes", may_agree_again, by_fewer_modes},
};

static enum percuss_status begin_comparison(struct comparison *comparison,
                                            struct attempt_context *context, struct attempt *best,
                                            struct mode_error *error)
{
    *comparison = (struct comparison){.context = context,
                                      .best = best,
                                      .error = error,
                                      .slow = *error,
                                      .first = context->neighbours->solutions == 1};
    return find_unfixed(comparison);
}

enum percuss_status refinement_compare(struct attempt_context *context, struct attempt *best,
                                       struct mode_error *error)
{
    struct comparison comparison;
    enum percuss_status status = begin_comparison(&comparison, context, best, error);
    for (size_t i = 0; !status && !comparison.decided && i < sizeof ESTIMATORS / sizeof *ESTIMATORS;
         i++)
        if (ESTIMATORS[i].applies(&comparison))
            status = ESTIMATORS[i].estimate(&comparison);
    return status;
}

/* Widens the error of a single impact of bodies with fewer modes by the catalogue than the
 * tolerance asks for by a solution that has them. */
static enum percuss_status compare_unfixed(struct attempt_context *context, struct attempt *best,
                                           struct mode_error *error)
{
    struct comparison comparison;
    enum percuss_status status = begin_comparison(&comparison, context, best, error);
    if (status || !comparison.fixed)
        return status;
    struct attempt *unfixed = &comparison.unfixed;
    status = solve_other(&comparison, &unfixed->assembly->scene, unfixed);
    if (!status)
        widen_by(&comparison, FACTOR_COMPARED, unfixed);
    return status;
}

/* ---- Modes ---- */

/* Each takes at least half of the error, as a rule a hundredth: more do not come. */
enum { MAX_RAISES = 8 };

/* To first order, as if the omitted modes followed the force slowly: their inertia and viscosity
 * change the approach by -inertia F'' - viscosity F', which does work on the contact's stiffness.
 * Effect on the restitution, of the contact where it is largest, and of a tangent alike: it is
 * about as stiff. */
static struct outcome_difference slow_effect(const struct attempt_context *context,
                                             const struct attempt *attempt)
{
    const struct problem *problem = context->problem;
    struct outcome_difference largest = {0.0, 0.0};
    for (size_t r = 0; r < problem_rows(problem); r++) {
        size_t c = problem_row_contact(problem, r);
        const struct track *track = &attempt->outcome.tracks[c];
        const struct omitted *omitted = &attempt->assembly->omitted[r];
        /* impulse by the inertia, energy by the viscosity */
        double compression = problem->impulse_compression[c];
        double impulse = omitted->inertia * track->inertia;
        double lost = omitted->viscosity * track->viscosity; /* J */
        double e = fabs(outcome_restitution(problem, &attempt->outcome, c));
        /* a contact at rest in a group is struck through its neighbours */
        double approach = compression * problem->w[c * (problem->contact_count + 1)];
        if (compression > 0.0)
            impulse += lost / (larger(e, LEAST_REBOUND) * approach);
        largest.impulse = larger(impulse, largest.impulse);
        if (compression > 0.0)
            largest.restitution = larger(impulse / compression, largest.restitution);
    }
    return largest;
}

static enum percuss_status estimate_modes(struct attempt_context *context, struct attempt *best,
                                          struct mode_error *error)
{
    struct outcome_difference slow = slow_effect(context, best);
    *error = (struct mode_error){.restitution = slow.restitution, .impulse = slow.impulse};
    bool spent = attempt_is_spent(best);
    bool exact = best->assembly->lowest_omitted == INFINITY;
    if (attempt_is_sequence(best) && !spent && !exact)
        return refinement_compare(context, best, error);
    error->restitution *= FACTOR_FIRST_ORDER;
    error->impulse *= FACTOR_FIRST_ORDER;
    return slow.restitution > MOST_MODES_SINGLE && !spent && !exact
               ? compare_unfixed(context, best, error)
               : PERCUSS_OK;
}

bool refinement_expects_sequence(const struct problem *problem)
{
    if (problem->contact_count > 1)
        return true;
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            const struct body_kind *kind = problem->bodies[side->body]->kind;
            for (size_t f = 0; f < kind->family_count; f++)
                if (side->load.family[f].acts &&
                    (kind->families[f]->bends || (kind->families[f]->returns &&
                                                  mode_choice_returns(problem, c, side->body, f))))
                    return true;
        }
    return false;
}

/* First-order effect of the omitted modes that the first attempt may have. */
static double first_allowed(const struct attempt_context *context, bool sequence)
{
    if (!sequence)
        return smaller(FIRST_MODES_SINGLE * context->problem->tolerance, MOST_MODES_SINGLE);
    bool group = context->problem->contact_count > 1;
    return smaller(FIRST_MODES_SEQUENCE * context->problem->tolerance,
                   group ? MOST_MODES_GROUP : MOST_MODES_SEQUENCE);
}

/* Whether another attempt can be better, and is affordable. */
static bool can_improve(const struct attempt *best, const struct mode_error *error)
{
    if (error->verdict == MODES_UNCHECKED || attempt_is_spent(best) || best->outcome.too_stiff)
        return false;
    if (error->verdict == MODES_BELOW_STEPS)
        return attempt_can_shorten(best->accuracy);
    return best->assembly->adjustable && !best->assembly->capped;
}

/* Whether it is not the same solution once more. */
static bool is_another(const struct attempt *next, const struct attempt *best)
{
    return next->accuracy != best->accuracy || !assembly_same_modes(next->assembly, best->assembly);
}

/* Shorter steps, or more modes: the error follows the allowed effect, but not closely in a
 * sequence. */
static void improve(const struct attempt_context *context, const struct mode_error *error,
                    struct attempt *next)
{
    double factor = AIM * context->problem->tolerance / error->restitution;
    if (error->verdict == MODES_BELOW_STEPS)
        next->accuracy = larger(next->accuracy / LONGER_STEPS, FINEST_STEPS);
    else
        next->choice.allowed *= smaller(factor, AIM);
}

static bool modes_suffice(const struct attempt_context *context, const struct mode_error *error)
{
    return error->verdict == MODES_AND_STEPS ||
           (error->verdict != MODES_BELOW_STEPS &&
            error->restitution <= SHARE_MODES * context->problem->tolerance);
}

enum percuss_status refine_modes(struct attempt_context *context, struct attempt *best,
                                 struct mode_error *error)
{
    bool sequence = refinement_expects_sequence(context->problem);
    best->choice = (struct mode_choice){.cut = INFINITY,
                                        .allowed = first_allowed(context, sequence),
                                        .most = REFINEMENT_MOST_MODES};
    *error = (struct mode_error){0};
    for (int raise = 0;; raise++) {
        /* the next attempt: more modes, or shorter steps */
        struct attempt next = *best;
        if (raise > 0)
            improve(context, error, &next);
        enum percuss_status status = attempt_assemble(context, &next);
        if (status)
            return status;
        best->choice = next.choice;
        /* solved where it is another one */
        if (raise == 0 || is_another(&next, best)) {
            status = attempt_run_logged(context, &next, &next.assembly->scene);
            if (status)
                return status;
            /* one that is cut off for its effort does not replace the one before */
            if (raise > 0 && attempt_is_spent(&next) && !next.outcome.too_stiff)
                return PERCUSS_OK;
            neighbours_begin(context->neighbours, context->problem, &next.outcome);
            if (raise > 0)
                neighbours_add(context->neighbours, context->problem, &best->outcome);
            *best = next;
            if (best->outcome.always_overlapped)
                return PERCUSS_OK;
            status = estimate_modes(context, best, error);
        }
        /* until it is good enough or cannot be better */
        if (status || modes_suffice(context, error) || raise >= MAX_RAISES ||
            !can_improve(best, error))
            return status;
    }
}

/* ---- Time steps ---- */

/* Each takes a hundredth: six digits in all. */
enum { MAX_TIGHTENINGS = 3 };

/* Effect of the time steps on the restitution without a second solution: the energy that the phases
 * gain or lose, as if all of it were the rebound's (e^2 is its share of the available energy), and
 * no less than steps of that accuracy leave. A soft contact hardly rebounds: e changes by the root
 * of its share. */
static double error_of_steps(const struct attempt_context *context, const struct attempt *best)
{
    double e = best->outcome.plastic > 0.0 ? 0.0 : LEAST_REBOUND;
    for (size_t c = 0; c < context->problem->contact_count; c++)
        e = larger(fabs(outcome_restitution(context->problem, &best->outcome, c)), e);
    double defect = outcome_energy_defect(context->problem, &best->outcome);
    if (context->problem->friction_count)
        defect = larger(defect - FRICTION_BOOKS * sqrt(best->accuracy), 0.0);
    defect *= DEFECT_FACTOR;
    double rebound = best->outcome.plastic > 0.0 ? e + sqrt(e * e + defect) : 2.0 * e;
    double change = defect > 0.0 ? defect / rebound : 0.0;
    return larger(change, attempt_steps_leave(best->accuracy));
}

static struct step_error estimate_alone(const struct attempt_context *context,
                                        const struct attempt *best)
{
    double restitution = error_of_steps(context, best);
    return (struct step_error){.restitution = restitution,
                               .impulse =
                                   restitution * problem_largest_compression(context->problem)};
}

/* Adds the difference to a solution with longer steps, `known` where there is one already. One that
 * was cut off says nothing. */
static enum percuss_status compare_steps(struct attempt_context *context,
                                         const struct attempt *best, const struct attempt *known,
                                         struct step_error *error)
{
    /* a solution with longer steps */
    struct attempt own = *best;
    if (!known) {
        own.accuracy *= LONGER_STEPS;
        if (attempt_is_sequence(best))
            attempt_by_other_means(&own);
        enum percuss_status status = attempt_run(context, &own, &best->assembly->scene);
        if (status)
            return status;
        known = &own;
    }
    if (attempt_is_spent(known)) {
        error->unchecked = attempt_is_sequence(best);
        return PERCUSS_OK;
    }
    /* the change that it makes */
    struct outcome_difference change =
        outcome_compare(context->problem, &best->outcome, &known->outcome);
    neighbours_add(context->neighbours, context->problem, &known->outcome);
    if (!attempt_is_sequence(best)) { /* better than any estimate */
        *error = (struct step_error){.restitution = change.restitution, .impulse = change.impulse};
        return PERCUSS_OK;
    }
    error->restitution = larger(FACTOR_COMPARED * change.restitution, error->restitution);
    error->impulse = larger(FACTOR_COMPARED * change.impulse, error->impulse);
    return PERCUSS_OK;
}

/* `coarse`: a solution with longer steps where there is one already. `compared`: the modes' error
 * has the steps' in it. */
static enum percuss_status estimate_steps(struct attempt_context *context,
                                          const struct attempt *best, const struct attempt *coarse,
                                          bool compared, struct step_error *error)
{
    bool sequence = attempt_is_sequence(best);
    *error = estimate_alone(context, best);
    if (compared || (!sequence && context->problem->tolerance >= TOLERANCE_COMPARED))
        return PERCUSS_OK;
    return compare_steps(context, best, coarse, error);
}

/* A hundred times finer steps. A solution that does not keep its energy is no answer: shorter steps
 * get more of the effort then. *found: it replaced the one before. */
static enum percuss_status shorten(struct attempt_context *context, struct attempt *best,
                                   bool keeps_energy, bool *found)
{
    struct attempt finer = *best;
    double allowed = attempt_work_allowed(context->problem->request->options.method);
    finer.accuracy = larger(best->accuracy / LONGER_STEPS, FINEST_STEPS);
    if (!keeps_energy)
        context->work = larger(context->work, LAST_WORK * allowed);
    enum percuss_status status = best->log
                                     ? attempt_run_logged(context, &finer, &best->assembly->scene)
                                     : attempt_run(context, &finer, &best->assembly->scene);
    *found = !status && (!attempt_is_spent(&finer) || !keeps_energy);
    if (*found)
        *best = finer;
    return status;
}

enum percuss_status refine_steps(struct attempt_context *context, struct attempt *best,
                                 const struct mode_error *modes, struct step_error *error)
{
    double tolerance = context->problem->tolerance;
    double closure_allowed = tolerance <= TOLERANCE_AUDITED
                                 ? 0.1 * TOLERANCE_AUDITED
                                 : smaller(CLOSURE * tolerance, OUTCOME_WORST_DEFECT);
    const struct attempt *coarse = modes->longer;
    struct attempt before;
    for (int i = 0;; i++) {
        /* the error of the steps now */
        bool compared = modes->verdict == MODES_AND_STEPS && i == 0;
        enum percuss_status status = estimate_steps(context, best, coarse, compared, error);
        if (status)
            return status;
        error->energy_defect = outcome_energy_defect(context->problem, &best->outcome);
        error->energy_closes =
            outcome_energy_closes(context->problem, &best->outcome, closure_allowed);
        bool enough = error->restitution <= SHARE_STEPS * tolerance && error->energy_closes;
        if (enough || i >= MAX_TIGHTENINGS || !attempt_can_shorten(best->accuracy) ||
            attempt_is_spent(best) || best->outcome.too_stiff)
            return PERCUSS_OK;
        bool found;
        before = *best;
        status = shorten(context, best, outcome_keeps_energy(error->energy_defect), &found);
        if (status || !found)
            return status;
        /* a last, smaller step down is no measure */
        coarse = best->accuracy > FINEST_STEPS ? &before : NULL;
        /* solutions with longer steps are not as accurate; their differences are in the errors */
        neighbours_begin(context->neighbours, context->problem, &best->outcome);
        neighbours_add(context->neighbours, context->problem, &before.outcome);
    }
}
