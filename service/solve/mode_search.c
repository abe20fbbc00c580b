/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/mode_search.h"

#include <math.h>

enum { MAX_RAISES = 6 };
/* Predicted effect of the omitted modes that the first attempt may have, in tolerances: a single
 * contact, and a beam, whose later sub-impacts amplify it five- to twentyfold as a rule. */
static const double FIRST_SINGLE = 0.25;
static const double FIRST_SEQUENCE = 0.02;
/* True error over the estimate, 19 of 20 random scenes: 1.2 for `slow_effect` (single contacts; 0.6
 * without damping), 1.5 for the difference to the next better model (docs/accuracy.md). */
static const double SINGLE_FACTOR = 2.0;
static const double SEQUENCE_FACTOR = 2.0;

/* To first order, as if the omitted modes followed the force slowly: their inertia and viscosity
 * change the approach by -inertia F'' - viscosity F', which does work on the contact's stiffness.
 * Effect on the restitution, of the contact where it is largest. */
static struct attempt_difference slow_effect(const struct attempt_context *context,
                                             const struct attempt *attempt)
{
    const struct geometry *geometry = context->geometry;
    struct attempt_difference largest = {0.0, 0.0};
    for (size_t c = 0; c < geometry->contact_count; c++) {
        const struct track *track = &attempt->outcome.tracks[c];
        const struct omitted *omitted = &attempt->assembly->omitted[c];
        double compression = geometry->impulse_compression[c];
        double impulse = omitted->inertia * track->inertia;
        double lost = omitted->viscosity * track->viscosity; /* J */
        double e = fabs(attempt_restitution(geometry, &attempt->outcome, c));
        if (compression > 0.0)
            impulse += lost / (fmax(e, 0.1) * fabs(geometry->gap_rate[c]));
        largest.impulse = fmax(largest.impulse, impulse);
        if (compression > 0.0)
            largest.restitution = fmax(largest.restitution, impulse / compression);
    }
    return largest;
}

/* A sequence amplifies errors, and not evenly: only a second solution shows by how much. */
static enum percuss_status compare_next_model(struct attempt_context *context, struct attempt *best,
                                              struct mode_error *error)
{
    struct attempt next = *best;
    struct scene scene;
    if (!assemble_remainder(best->assembly, context->geometry, context->cache, context->arena,
                            &scene))
        return PERCUSS_INTERNAL;
    enum percuss_status status = attempt_run(context, &next, &scene);
    if (status)
        return status;
    best->outcome.too_stiff = next.outcome.too_stiff;
    struct attempt_difference change = attempt_compare(context, best, &next);
    struct attempt_difference slow = {error->restitution, error->impulse};
    error->restitution = fmax(slow.restitution, SEQUENCE_FACTOR * change.restitution);
    error->impulse = fmax(slow.impulse, SEQUENCE_FACTOR * change.impulse);
    if (slow.restitution > 0.0)
        error->amplification = fmax(1.0, change.restitution / slow.restitution);
    return PERCUSS_OK;
}

static enum percuss_status estimate(struct attempt_context *context, struct attempt *best,
                                    struct mode_error *error)
{
    struct attempt_difference slow = slow_effect(context, best);
    *error = (struct mode_error){slow.restitution, slow.impulse, 1.0};
    bool spent = attempt_is_spent(best);
    bool exact = best->assembly->lowest_omitted == INFINITY;
    if (attempt_is_sequence(best) && !spent && !exact)
        return compare_next_model(context, best, error);
    error->restitution *= SINGLE_FACTOR;
    error->impulse *= SINGLE_FACTOR;
    return PERCUSS_OK;
}

bool mode_search_expects_sequence(const struct geometry *geometry)
{
    for (size_t c = 0; c < geometry->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const bool *acts = geometry->sides[c][which].load.acts;
            if (acts[FAMILY_BENDING_Y] || acts[FAMILY_BENDING_Z])
                return true;
        }
    return false;
}

/* Whether another attempt can be better, and is affordable. */
static bool can_raise(const struct attempt *best)
{
    return best->assembly->adjustable && !best->assembly->capped && !attempt_is_spent(best) &&
           !best->outcome.too_stiff;
}

enum percuss_status mode_search(struct attempt_context *context, struct attempt *best,
                                struct mode_error *error)
{
    bool sequence = mode_search_expects_sequence(context->geometry);
    double first = sequence ? FIRST_SEQUENCE : FIRST_SINGLE;
    best->choice = (struct mode_choice){
        .cut = INFINITY, .allowed = first * context->tolerance, .most = MODE_SEARCH_MOST};
    *error = (struct mode_error){.amplification = 1.0};
    for (int raise = 0;; raise++) {
        struct attempt next = *best;
        enum percuss_status status = attempt_assemble(context, &next);
        if (status)
            return status;
        if (raise == 0 || !assembly_same_modes(next.assembly, best->assembly)) {
            status = attempt_run(context, &next, &next.assembly->scene);
            /* what is cut off for its effort does not replace what was solved */
            if (!status && raise > 0 && attempt_is_spent(&next) && !next.outcome.too_stiff)
                return PERCUSS_OK;
            *best = next;
            if (status || best->outcome.always_overlapped)
                return status;
            status = estimate(context, best, error);
        }
        if (status || error->restitution <= 0.7 * context->tolerance || raise >= MAX_RAISES ||
            !can_raise(best))
            return status;
        /* the error follows what is allowed, but not closely in a sequence */
        double factor = 0.5 * context->tolerance / error->restitution;
        best->choice.allowed *= fmin(fmax(factor, 0.01), 0.5);
    }
}
