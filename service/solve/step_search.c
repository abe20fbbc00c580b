/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/step_search.h"

#include <math.h>

#include "solve/first_steps.h"
#include "solve/nearby.h"

/* Each takes a hundredth: six digits in all. */
enum { MAX_TIGHTENINGS = 3 };
/* How closely the audit must close where the tolerance asks for it; otherwise as CLOSURE
 * tolerances. */
static const double AUDIT = 1e-9;
static const double CLOSURE = 10.0;
/* The energy's defect counts so many times, to be safe. */
static const double SAFETY = 4.0;
/* Of ATTEMPT_LONGER: rounding. */
static const double ALMOST = 0.99;
/* Of the effort allowed: for shorter steps where those that it sufficed for lose the energy. */
static const double LAST_EFFORT = 0.5;
/* Of a long one, or a group, another solution is asked for. */
static const double SLIGHTLY_LONGER = 10.0;

/* Least restitution that an elastic contact's rebound is taken for: what it gives to vibration
 * leaves it with speed. */
static const double ELASTIC_REBOUND = 0.1;

/* Effect of the time steps on the restitution without a second solution: the energy that the phases
 * gain or lose, as if all of it were the rebound's (e^2 is its share of what is available; four
 * times the energy, to be safe), and not less than what the accuracy asked for has been seen to
 * leave (docs/accuracy.md). A soft contact hardly rebounds: e changes by the root of its share. */
static double error_of_steps(const struct attempt_context *context, const struct attempt *best)
{
    double e = best->outcome.plastic > 0.0 ? 0.0 : ELASTIC_REBOUND;
    for (size_t c = 0; c < context->problem->contact_count; c++)
        e = fmax(e, fabs(outcome_restitution(context->problem, &best->outcome, c)));
    double defect = SAFETY * outcome_energy_defect(context->problem, &best->outcome);
    double rebound = best->outcome.plastic > 0.0 ? e + sqrt(e * e + defect) : 2.0 * e;
    double change = defect > 0.0 ? defect / rebound : 0.0;
    return fmax(change, attempt_steps_leave(best->accuracy));
}

static struct step_error estimate_alone(const struct attempt_context *context,
                                        const struct attempt *best)
{
    double restitution = error_of_steps(context, best);
    return (struct step_error){.restitution = restitution,
                               .impulse =
                                   restitution * problem_largest_compression(context->problem)};
}

/* Adds what a solution with longer steps says, `known` where there is one already. What was cut off
 * says nothing. */
static enum percuss_status compare(struct attempt_context *context, const struct attempt *best,
                                   double longer, const struct attempt *known,
                                   struct step_error *error)
{
    /* a solution with longer steps */
    struct attempt own = *best;
    if (!known) {
        own.accuracy *= longer;
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
    /* what that changes */
    struct outcome_difference change =
        outcome_compare(context->problem, &best->outcome, &known->outcome);
    nearby_add(context->nearby, context->problem, &known->outcome);
    if (!attempt_is_sequence(best)) { /* better than any estimate */
        *error = (struct step_error){.restitution = change.restitution, .impulse = change.impulse};
        return PERCUSS_OK;
    }
    error->restitution = fmax(error->restitution, SEQUENCE_FACTOR * change.restitution);
    error->impulse = fmax(error->impulse, SEQUENCE_FACTOR * change.impulse);
    return PERCUSS_OK;
}

/* `coarse`: a solution with longer steps where there is one already. `compared`: the modes' error
 * has the steps' in it. */
static enum percuss_status estimate(struct attempt_context *context, const struct attempt *best,
                                    const struct attempt *coarse, bool compared,
                                    struct step_error *error)
{
    bool sequence = attempt_is_sequence(best);
    *error = estimate_alone(context, best);
    if (compared || (!sequence && context->problem->tolerance >= FIRST_STEPS_COMPARED))
        return PERCUSS_OK;
    enum percuss_status status = compare(context, best, ATTEMPT_LONGER, coarse, error);
    bool again = sequence && (attempt_is_long(best) || context->problem->contact_count > 1);
    if (!status && again &&
        error->restitution <= SEQUENCE_STEPS_SHARE * context->problem->tolerance)
        status = compare(context, best, SLIGHTLY_LONGER, NULL, error);
    return status;
}

enum percuss_status step_search(struct attempt_context *context, struct attempt *best,
                                const struct mode_error *modes, struct step_error *error)
{
    /* how well the energy must close */
    double tolerance = context->problem->tolerance;
    enum percuss_method method = context->problem->request->options.method;
    double closure_allowed =
        tolerance <= FIRST_STEPS_AUDITED ? AUDIT : fmin(CLOSURE * tolerance, OUTCOME_WORST_DEFECT);
    const struct attempt *coarse = modes->longer;
    struct attempt before;
    for (int i = 0;; i++) {
        bool compared = modes->covers_steps && i == 0;
        /* what the steps do now */
        enum percuss_status status = estimate(context, best, coarse, compared, error);
        if (status)
            return status;
        error->energy_defect = outcome_energy_defect(context->problem, &best->outcome);
        error->energy_closes =
            outcome_energy_closes(context->problem, &best->outcome, closure_allowed);
        bool enough =
            error->restitution <= SEQUENCE_STEPS_SHARE * tolerance && error->energy_closes;
        if (enough || i >= MAX_TIGHTENINGS || !attempt_can_shorten(best->accuracy) ||
            attempt_is_spent(best) || best->outcome.too_stiff)
            return PERCUSS_OK;
        /* a hundred times finer ones */
        struct attempt finer = *best;
        finer.accuracy = fmax(best->accuracy / ATTEMPT_LONGER, ATTEMPT_FINEST);
        /* what does not keep its energy is no answer: as far as shorter steps come is one */
        bool lost = !outcome_keeps_energy(error->energy_defect);
        if (lost)
            context->work = fmax(context->work, LAST_EFFORT * attempt_work_allowed(method));
        status = best->log ? attempt_run_logged(context, &finer, &best->assembly->scene)
                           : attempt_run(context, &finer, &best->assembly->scene);
        if (status || (attempt_is_spent(&finer) && !lost))
            return status;
        before = *best;
        *best = finer;
        /* a last, smaller step down is no measure */
        coarse = before.accuracy > ALMOST * ATTEMPT_LONGER * best->accuracy ? &before : NULL;
        /* those with longer steps are not as accurate; what they said is in the errors */
        nearby_begin(context->nearby, context->problem, &best->outcome);
        nearby_add(context->nearby, context->problem, &before.outcome);
    }
}
