/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/mode_search.h"

#include <math.h>

#include "solve/mode_share.h"
#include "solve/nearby.h"

/* Each takes at least half of the error, as a rule a hundredth: more do not come. */
enum { MAX_RAISES = 8 };
/* What the next attempt aims at, in tolerances; and by how much it may change what is allowed. */
static const double AIM = 0.5;
static const double LARGEST_RAISE = 0.01;
static const double SMALLEST_RAISE = 0.5;
/* Least restitution that viscosity is counted against: a contact that hardly rebounds has no more
 * of the approach to lose. */
static const double LEAST_REBOUND = 0.1;
/* Predicted effect of the omitted modes that the first attempt may have, in tolerances: a single
 * contact, and a beam, whose later sub-impacts amplify it five- to twentyfold as a rule. */
static const double FIRST_SINGLE = 0.2;
static const double FIRST_SEQUENCE = 0.02;
/* The most that it may have of a single blow, see SEQUENCE_MOST. */
static const double MOST_SINGLE = 4e-4;
/* True error over `slow_effect`: below 2 for 98 of 100 random scenes (docs/accuracy.md). */
static const double SINGLE_FACTOR = 2.5;

/* To first order, as if the omitted modes followed the force slowly: their inertia and viscosity
 * change the approach by -inertia F'' - viscosity F', which does work on the contact's stiffness.
 * Effect on the restitution, of the contact where it is largest. */
static struct outcome_difference slow_effect(const struct attempt_context *context,
                                             const struct attempt *attempt)
{
    const struct problem *problem = context->problem;
    struct outcome_difference largest = {0.0, 0.0};
    for (size_t c = 0; c < problem->contact_count; c++) {
        const struct track *track = &attempt->outcome.tracks[c];
        const struct omitted *omitted = &attempt->assembly->omitted[c];
        /* impulse by the inertia, energy by the viscosity */
        double compression = problem->impulse_compression[c];
        double impulse = omitted->inertia * track->inertia;
        double lost = omitted->viscosity * track->viscosity; /* J */
        double e = fabs(outcome_restitution(problem, &attempt->outcome, c));
        /* a contact at rest in a group is struck through its neighbours */
        double approach = compression * problem->w[c * (problem->contact_count + 1)];
        if (compression > 0.0)
            impulse += lost / (fmax(e, LEAST_REBOUND) * approach);
        largest.impulse = fmax(largest.impulse, impulse);
        if (compression > 0.0)
            largest.restitution = fmax(largest.restitution, impulse / compression);
    }
    return largest;
}

static enum percuss_status estimate(struct attempt_context *context, struct attempt *best,
                                    struct mode_error *error)
{
    struct outcome_difference slow = slow_effect(context, best);
    *error = (struct mode_error){.restitution = slow.restitution, .impulse = slow.impulse};
    bool spent = attempt_is_spent(best);
    bool exact = best->assembly->lowest_omitted == INFINITY;
    if (attempt_is_sequence(best) && !spent && !exact)
        return sequence_compare(context, best, error);
    error->restitution *= SINGLE_FACTOR;
    error->impulse *= SINGLE_FACTOR;
    return slow.restitution > MOST_SINGLE && !spent && !exact
               ? sequence_compare_unfixed(context, best, error)
               : PERCUSS_OK;
}

bool mode_search_expects_sequence(const struct problem *problem)
{
    if (problem->contact_count > 1)
        return true;
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            const struct body_kind *kind = problem->bodies[side->body]->kind;
            for (size_t f = 0; f < kind->family_count; f++)
                if (side->load.family[f].acts &&
                    (kind->families[f]->bends ||
                     (kind->families[f]->returns && mode_share_returns(problem, c, side->body, f))))
                    return true;
        }
    return false;
}

static double first_allowed(const struct attempt_context *context, bool sequence)
{
    if (!sequence)
        return fmin(FIRST_SINGLE * context->problem->tolerance, MOST_SINGLE);
    bool group = context->problem->contact_count > 1;
    return fmin(FIRST_SEQUENCE * context->problem->tolerance,
                group ? SEQUENCE_MOST_GROUP : SEQUENCE_MOST);
}

/* Whether another attempt can be better, and is affordable. */
static bool can_improve(const struct attempt *best, const struct mode_error *error)
{
    bool raise = best->assembly->adjustable && !best->assembly->capped;
    bool shorter = error->by_steps && attempt_can_shorten(best->accuracy);
    return (error->by_steps ? shorter : raise) && !error->unchecked && !attempt_is_spent(best) &&
           !best->outcome.too_stiff;
}

/* Whether it is not the same solution once more. */
static bool is_another(const struct attempt *next, const struct attempt *best)
{
    return next->accuracy != best->accuracy || !assembly_same_modes(next->assembly, best->assembly);
}

/* Shorter steps, or more modes: the error follows what is allowed, but not closely in a sequence.
 */
static void improve(const struct attempt_context *context, const struct mode_error *error,
                    struct attempt *next)
{
    double factor = AIM * context->problem->tolerance / error->restitution;
    if (error->by_steps)
        next->accuracy = fmax(next->accuracy / ATTEMPT_LONGER, ATTEMPT_FINEST);
    else
        next->choice.allowed *= fmin(fmax(factor, LARGEST_RAISE), SMALLEST_RAISE);
}

enum percuss_status mode_search(struct attempt_context *context, struct attempt *best,
                                struct mode_error *error)
{
    bool sequence = mode_search_expects_sequence(context->problem);
    best->choice = (struct mode_choice){
        .cut = INFINITY, .allowed = first_allowed(context, sequence), .most = MODE_SEARCH_MOST};
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
            /* what is cut off for its effort does not replace what was solved */
            if (raise > 0 && attempt_is_spent(&next) && !next.outcome.too_stiff)
                return PERCUSS_OK;
            nearby_begin(context->nearby, context->problem, &next.outcome);
            if (raise > 0)
                nearby_add(context->nearby, context->problem, &best->outcome);
            *best = next;
            if (best->outcome.always_overlapped)
                return PERCUSS_OK;
            status = estimate(context, best, error);
        }
        /* until it is good enough or cannot be better */
        bool enough = error->covers_steps ||
                      error->restitution <= SEQUENCE_MODES_SHARE * context->problem->tolerance;
        if (status || (enough && !error->by_steps) || raise >= MAX_RAISES ||
            !can_improve(best, error))
            return status;
    }
}
