/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/sequence.h"

#include <math.h>

#include "solve/assemble.h"
#include "solve/nearby.h"

/* A change that is so many times what was left out is that of a sequence that amplifies; 10 times
 * and less are the rule. */
static const double STRONG = 30.0;
/* Share of the tolerance below which what was left out counts as that much. */
static const double NOTHING = 0.01;
/* Share of the tolerance that modes and steps may take together. */
static const double BOTH_SHARE = 0.9;
/* How many times as much the solution with fewer modes leaves out, and how much of its change is
 * this one's error: less than a tenth where errors grow evenly, all of it where they have reached
 * their range; half covers all of some hundred random sequences of ten and more. */
static const double FEWER = 10.0;
static const double FEWER_FACTOR = 0.5;

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

/* The first other solution has the next better model and longer steps at once: where the first
 * attempt agrees with it the answer is good. Where not, or where the agreement may be chance, there
 * are more. */
enum percuss_status sequence_compare(struct attempt_context *context, struct attempt *best,
                                     struct mode_error *error)
{
    const struct mode_error slow = *error;
    bool first = context->nearby->solutions == 1;
    struct attempt both = *best;
    struct scene better;
    /* a better model with longer steps */
    both.accuracy *= ATTEMPT_LONGER;
    if (!assemble_remainder(best->assembly, context->problem, &better))
        return PERCUSS_INTERNAL;
    enum percuss_status status = solve_beside(context, best, &better, &both, error);
    if (status || error->unchecked)
        return status;
    /* good where they agree, unless that may be chance */
    struct outcome_difference change =
        outcome_compare(context->problem, &best->outcome, &both.outcome);
    bool is_long =
        attempt_is_long(best) ||
        change.restitution > STRONG * fmax(slow.restitution, NOTHING * context->problem->tolerance);
    widen(error, SEQUENCE_FACTOR, change);
    error->covers_steps =
        first && !is_long && error->restitution <= BOTH_SHARE * context->problem->tolerance;
    if (error->covers_steps)
        return PERCUSS_OK;
    /* otherwise which of the two makes the difference */
    *error = slow;
    status = tell_apart(context, best, &both, error);
    if (status || error->unchecked || error->by_steps ||
        error->restitution > SEQUENCE_MODES_SHARE * context->problem->tolerance)
        return status;
    return compare_again(context, best, &better, is_long, error);
}
