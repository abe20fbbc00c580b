/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/sequence.h"

#include <math.h>

#include "impact/tangent.h"
#include "solve/assemble.h"
#include "solve/fewer.h"
#include "solve/first_steps.h"
#include "solve/nearby.h"

/* A change that is so many times what was left out is that of a sequence that amplifies; 10 times
 * and less are the rule. */
static const double STRONG = 30.0;
/* Restitution of a contact that others strike: they give it a fifth of its impulse and more. And
 * its share of the group's largest impulse of compression: what steps leave goes with the others'
 * forces, and is much of so little. */
static const double STRUCK = 1.5;
static const double SLIGHT = 0.01;
/* Share of the tolerance below which what was left out counts as that much. */
static const double NOTHING = 0.01;
/* Share of the tolerance that modes and steps may take together. */
static const double BOTH_SHARE = 0.9;
/* How many times as much the solution with fewer modes leaves out, and how much of its change is
 * this one's error: less than a tenth where errors grow evenly, all of it where they have reached
 * their range; half covers all of some hundred random sequences of ten and more. */
static const double FEWER = 10.0;
static const double FEWER_FACTOR = 0.5;
/* Change of a sub-impact's impulse by what is left out, up to which first order says it: within 2 %
 * of random sequences. */
static const double STRAIN = 0.1;
/* True error over what first order says of the omitted modes: below 2 for 98 of 100 random
 * sequences. */
static const double FIRST_ORDER_FACTOR = 2.5;
/* What steps leave of e of sequences whose omitted modes do not tell is below this for 98 of 100
 * random ones (docs/accuracy.md): with the first accuracy of coarse tolerances, and of finer ones.
 */
static const double STRAY_COARSE = 6e-5;
static const double STRAY_FINE = 4e-5;

static void widen(struct mode_error *error, double factor, struct outcome_difference change)
{
    error->restitution = fmax(error->restitution, factor * change.restitution);
    error->impulse = fmax(error->impulse, factor * change.impulse);
}

/* Solves another scene of the same contacts, or the same with other steps. What was cut off says
 * nothing: error->unchecked. */
static enum percuss_status solve_beside(struct attempt_context *context, struct attempt *best,
                                        const struct scene *scene, struct attempt *other,
                                        struct mode_error *error)
{
    attempt_by_other_means(other);
    enum percuss_status status = attempt_run(context, other, scene);
    if (status)
        return status;
    best->outcome.too_stiff = best->outcome.too_stiff || other->outcome.too_stiff;
    error->unchecked = error->unchecked || attempt_is_spent(other);
    if (!error->unchecked)
        nearby_add(context->nearby, context->problem, &other->outcome);
    return PERCUSS_OK;
}

/* With fewer modes. No change where there are none to leave out: those that a state or the
 * catalogue demands. */
static enum percuss_status compare_fewer_modes(struct attempt_context *context,
                                               struct attempt *best, struct mode_error *error)
{
    struct attempt fewer = *best;
    fewer.choice.allowed *= FEWER;
    enum percuss_status status = attempt_assemble(context, &fewer);
    if (status || assembly_same_modes(fewer.assembly, best->assembly))
        return status;
    status = solve_beside(context, best, &fewer.assembly->scene, &fewer, error);
    if (!status && !error->unchecked)
        widen(error, FEWER_FACTOR,
              outcome_compare(context->problem, &best->outcome, &fewer.outcome));
    return status;
}

/* Where the catalogue fixes numbers of modes, with as many as leave out a tenth of `slow`, which is
 * what the answer leaves out, or as few as the tolerance asks for; not by CVODE, whose effort goes
 * with the highest frequency. *more: that they are. */
static enum percuss_status unfix(struct attempt_context *context, const struct attempt *best,
                                 double slow, struct attempt *unfixed, bool *more)
{
    const struct problem *problem = context->problem;
    bool fixed = false;
    *unfixed = *best;
    *more = false;
    for (size_t b = 0; b < problem->body_count; b++)
        fixed = fixed || problem->bodies[b]->modes > 0;
    if (!fixed || problem->request->options.method == PERCUSS_METHOD_CVODE)
        return PERCUSS_OK;
    double most = problem->contact_count > 1 ? SEQUENCE_MOST_GROUP : SEQUENCE_MOST;
    unfixed->choice.unfixed = true;
    unfixed->choice.allowed = fmax(unfixed->choice.allowed, fmin(slow / FEWER, most));
    enum percuss_status status = attempt_assemble(context, unfixed);
    *more = !status && !assembly_same_modes(unfixed->assembly, best->assembly);
    return status;
}

enum percuss_status sequence_compare_unfixed(struct attempt_context *context, struct attempt *best,
                                             struct mode_error *error)
{
    struct attempt unfixed;
    bool more;
    enum percuss_status status = unfix(context, best, error->restitution, &unfixed, &more);
    if (status || !more)
        return status;
    status = solve_beside(context, best, &unfixed.assembly->scene, &unfixed, error);
    if (!status && !error->unchecked)
        widen(error, SEQUENCE_FACTOR,
              outcome_compare(context->problem, &best->outcome, &unfixed.outcome));
    return status;
}

/* Two solutions with longer steps may agree by chance: the better model with the answer's own, and
 * for a long sequence one more. */
static enum percuss_status compare_again(struct attempt_context *context, struct attempt *best,
                                         const struct scene *better, bool is_long,
                                         struct mode_error *error)
{
    struct attempt next = *best;
    enum percuss_status status = solve_beside(context, best, better, &next, error);
    if (status || error->unchecked)
        return status;
    widen(error, SEQUENCE_FACTOR, outcome_compare(context->problem, &best->outcome, &next.outcome));
    if (!is_long || error->restitution > SEQUENCE_MODES_SHARE * context->problem->tolerance)
        return PERCUSS_OK;
    return compare_fewer_modes(context, best, error);
}

/* Whether first order is asked: steps of the first accuracy leave little of the tolerance (of a
 * group at times a hundred times what is left out of the modes, which other steps alone tell), and
 * the bodies do not ring already, when forces would not be slow. */
static bool is_followed(const struct attempt_context *context, const struct attempt *best)
{
    for (size_t b = 0; b < context->problem->body_count; b++)
        if (context->problem->states[b])
            return false;
    double tolerance = context->problem->tolerance;
    bool fine = best->accuracy <= first_steps_accuracy(tolerance, true, false);
    bool alone = context->problem->contact_count == 1;
    return alone && context->nearby->solutions == 1 && attempt_is_followed(context, best) &&
           (tolerance >= FIRST_STEPS_FOLLOWED || (fine && tolerance >= FIRST_STEPS_FOLLOWED_FINE));
}

/* What inertia and viscosity of the omitted modes do, followed along the answer with fewer modes.
 */
static enum percuss_status follow(struct attempt_context *context, struct attempt *best,
                                  struct tangent *tangent)
{
    struct scene scene;
    const struct omitted *omitted = &best->assembly->omitted[0];
    const struct tangent_source source = {.viscosity = omitted->viscosity,
                                          .inertia = omitted->inertia};
    if (!fewer_modes(context->problem, &best->assembly->scene, &best->outcome, FEWER_FIRST_ORDER,
                     &scene))
        return PERCUSS_INTERNAL;
    best->path = tangent_path_create(&scene, best->log, context->arena);
    return tangent_follow(best->path, &source, context->pace, tangent);
}

/* What the first order says of the bodies' vibration, which is wrong by as much more as the impulse
 * is: by steps, too. */
static void find_vibration(struct attempt_context *context, const struct attempt *best,
                           const struct tangent *tangent, double more)
{
    double *vibration = context->nearby->vibration;
    for (size_t b = 0; b < context->problem->body_count; b++)
        vibration[b] = fmax(vibration[b], more * more * tangent_vibration(best->path, tangent, b));
}

/* By first order, where that says it; *known then. */
static enum percuss_status by_first_order(struct attempt_context *context, struct attempt *best,
                                          struct mode_error *error, bool *known)
{
    struct tangent tangent;
    *known = false;
    if (!is_followed(context, best))
        return PERCUSS_OK;
    enum percuss_status status = follow(context, best, &tangent);
    if (status)
        return status;
    /* not where it amplifies too much */
    double slow = error->restitution;
    double compression = problem_largest_compression(context->problem);
    double change = tangent.largest / compression;
    error->strained = tangent.strain / slow;
    if (!(tangent.strain <= STRAIN) ||
        change > STRONG * fmax(slow, NOTHING * context->problem->tolerance))
        return PERCUSS_OK;
    /* what the steps leave of one blow is amplified alike */
    double modes = FIRST_ORDER_FACTOR * change;
    double tolerance = context->problem->tolerance;
    double stray = tolerance >= FIRST_STEPS_FOLLOWED ? STRAY_COARSE : STRAY_FINE;
    double steps = fmax(attempt_steps_leave(best->accuracy) * fmax(1.0, change / slow), stray);
    double allowed = BOTH_SHARE * tolerance;
    double both = hypot(modes, steps); /* nothing makes the one follow the other */
    *known = modes > allowed || both <= allowed;
    if (!*known)
        return PERCUSS_OK;
    error->restitution = both;
    error->impulse = error->restitution * compression;
    error->covers_steps = modes <= allowed;
    if (change > 0.0)
        find_vibration(context, best, &tangent, hypot(change, steps) / change);
    return PERCUSS_OK;
}

/* Which of the two differences of `both` is large: that of the model or that of the steps. */
static enum percuss_status tell_apart(struct attempt_context *context, struct attempt *best,
                                      const struct attempt *both, struct mode_error *error)
{
    /* the same model with longer steps */
    struct attempt *longer = arena_take(context->arena, 1, sizeof *longer);
    if (!longer)
        return PERCUSS_INTERNAL;
    *longer = *best;
    longer->accuracy = both->accuracy;
    enum percuss_status status = solve_beside(context, best, &best->assembly->scene, longer, error);
    if (status || error->unchecked)
        return status;
    /* the steps' part of the difference, and the model's */
    double steps = SEQUENCE_FACTOR *
                   outcome_compare(context->problem, &best->outcome, &longer->outcome).restitution;
    widen(error, SEQUENCE_FACTOR,
          outcome_compare(context->problem, &longer->outcome, &both->outcome));
    error->longer = longer;
    /* whichever is further from its share */
    double allowed = SEQUENCE_STEPS_SHARE * context->problem->tolerance;
    double modes = SEQUENCE_STEPS_SHARE / SEQUENCE_MODES_SHARE * error->restitution;
    error->by_steps = steps > fmax(allowed, modes);
    return PERCUSS_OK;
}

/* Whether a contact of a group gets much of its impulse by way of others, or has little of its own:
 * what steps leave of theirs is large there, and one comparison may agree by chance. */
static bool is_struck_by_others(const struct attempt_context *context, const struct attempt *best)
{
    const struct problem *problem = context->problem;
    size_t n = problem->contact_count;
    double slight = SLIGHT * problem_largest_compression(problem);
    for (size_t c = 0; n > 1 && c < n; c++)
        if (outcome_restitution(problem, &best->outcome, c) > STRUCK ||
            (problem->impulse_compression[c] > 0.0 && problem->impulse_compression[c] < slight))
            return true;
    return false;
}

/* Where first order does not say it, the first other solution has the next better model and longer
 * steps at once: where the first attempt agrees with it the answer is good. Where not, or where the
 * agreement may be chance, there are more. */
enum percuss_status sequence_compare(struct attempt_context *context, struct attempt *best,
                                     struct mode_error *error)
{
    const struct mode_error slow = *error;
    bool first = context->nearby->solutions == 1;
    bool known = false;
    bool more;
    struct attempt unfixed;
    enum percuss_status status = unfix(context, best, error->restitution, &unfixed, &more);
    if (!status && !more)
        status = by_first_order(context, best, error, &known);
    if (status || known)
        return status;
    /* a better model with longer steps */
    struct attempt both = *best;
    struct scene better = unfixed.assembly->scene;
    both.accuracy *= ATTEMPT_LONGER;
    if (!more && !assemble_remainder(best->assembly, context->problem, &better))
        return PERCUSS_INTERNAL;
    status = solve_beside(context, best, &better, &both, error);
    if (status || error->unchecked)
        return status;
    /* good where they agree, unless that may be chance: of a contact that others strike the better
     * model with the answer's own steps tells */
    struct outcome_difference change =
        outcome_compare(context->problem, &best->outcome, &both.outcome);
    double strained = change.restitution / slow.restitution;
    bool is_long =
        attempt_is_long(best) ||
        change.restitution > STRONG * fmax(slow.restitution, NOTHING * context->problem->tolerance);
    widen(error, SEQUENCE_FACTOR, change);
    error->strained = strained;
    bool agrees =
        first && !is_long && error->restitution <= BOTH_SHARE * context->problem->tolerance;
    bool is_struck = is_struck_by_others(context, best);
    if (agrees && is_struck) {
        status = compare_again(context, best, &better, false, error);
        agrees =
            !error->unchecked && error->restitution <= BOTH_SHARE * context->problem->tolerance;
    }
    error->covers_steps = agrees;
    if (status || error->unchecked || agrees)
        return status;
    /* otherwise which of the two makes the difference */
    *error = slow;
    error->strained = strained;
    status = tell_apart(context, best, &both, error);
    if (status || error->unchecked || error->by_steps ||
        error->restitution > SEQUENCE_MODES_SHARE * context->problem->tolerance)
        return status;
    return compare_again(context, best, &better, is_long || is_struck, error);
}
