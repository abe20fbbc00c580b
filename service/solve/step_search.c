/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/step_search.h"

#include <math.h>

enum { MAX_TIGHTENINGS = 3 };
/* Finest accuracy of the time steps that is tried. */
static const double FINEST = 1e-17;
/* Accuracies of the time steps that are compared, and tried one after the other. */
static const double LONGER = 100.0;
/* From here down longer steps are tried for comparison. */
static const double COMPARE_BELOW = 1e-5;

/* The audit must close to 1e-9 where the tolerance is 1e-8 or less. */
double step_search_first_accuracy(double tolerance, bool sequence)
{
    double share = tolerance <= 1e-8 ? 1e-3 : sequence ? 0.01 : 0.1;
    return fmax(share * tolerance, FINEST);
}

/* Least restitution that an elastic contact's rebound is taken for: what it gives to vibration
 * leaves it with speed. */
static const double ELASTIC_REBOUND = 0.1;

/* Effect of the time steps on the restitution without a second solution: the energy that the phases
 * gain or lose, as if all of it were the rebound's (e^2 is its share of what is available; four
 * times the energy, to be safe), and not less than what the accuracy asked for has been seen to
 * leave (docs/accuracy.md). A soft contact hardly rebounds: e changes by the root of its share. */
static double error_of_steps(const struct attempt_context *context, const struct attempt *best,
                             double amplification)
{
    double e = best->outcome.plastic > 0.0 ? 0.0 : ELASTIC_REBOUND;
    for (size_t c = 0; c < context->geometry->contact_count; c++)
        e = fmax(e, fabs(attempt_restitution(context->geometry, &best->outcome, c)));
    double defect = 4.0 * attempt_energy_defect(context->geometry, &best->outcome);
    double rebound = best->outcome.plastic > 0.0 ? e + sqrt(e * e + defect) : 2.0 * e;
    double change = defect > 0.0 ? defect / rebound : 0.0;
    return amplification * fmax(change, 0.1 * pow(best->accuracy, 0.8));
}

static enum percuss_status estimate_alone(const struct attempt_context *context,
                                          const struct attempt *best, double amplification,
                                          struct step_error *error)
{
    double largest = 0.0;
    for (size_t c = 0; c < context->geometry->contact_count; c++)
        largest = fmax(largest, context->geometry->impulse_compression[c]);
    error->restitution = error_of_steps(context, best, amplification);
    error->impulse = error->restitution * largest;
    return PERCUSS_OK;
}

/* Compares with a solution of longer steps where the tolerance is tight, estimates otherwise.
 * `coarse` is that solution where there is one already. */
static enum percuss_status estimate(struct attempt_context *context, const struct attempt *best,
                                    const struct attempt *coarse, double amplification,
                                    struct step_error *error)
{
    if (context->tolerance >= COMPARE_BELOW)
        return estimate_alone(context, best, amplification, error);
    struct attempt own = *best;
    if (!coarse) {
        own.accuracy *= LONGER;
        enum percuss_status status = attempt_run(context, &own, &best->assembly->scene);
        if (status)
            return status;
        coarse = &own;
    }
    if (attempt_is_spent(coarse))
        return estimate_alone(context, best, amplification, error);
    struct attempt_difference change = attempt_compare(context, best, coarse);
    error->restitution = change.restitution;
    error->impulse = change.impulse;
    return PERCUSS_OK;
}

enum percuss_status step_search(struct attempt_context *context, struct attempt *best,
                                double amplification, struct step_error *error)
{
    double closure_allowed =
        context->tolerance <= 1e-8 ? 1e-9 : fmin(10.0 * context->tolerance, ATTEMPT_WORST_DEFECT);
    struct attempt before = *best;
    for (int i = 0;; i++) {
        bool known = before.accuracy > 0.99 * LONGER * best->accuracy;
        enum percuss_status status =
            estimate(context, best, known ? &before : NULL, amplification, error);
        if (status)
            return status;
        error->energy_defect = attempt_energy_defect(context->geometry, &best->outcome);
        error->energy_closes = error->energy_defect <= closure_allowed;
        bool enough = error->restitution <= 0.3 * context->tolerance && error->energy_closes;
        if (enough || i >= MAX_TIGHTENINGS || best->accuracy < 1.01 * FINEST ||
            attempt_is_spent(best) || best->outcome.too_stiff)
            return PERCUSS_OK;
        struct attempt finer = *best;
        finer.accuracy = fmax(best->accuracy / LONGER, FINEST);
        status = attempt_run(context, &finer, &best->assembly->scene);
        if (status || attempt_is_spent(&finer))
            return status;
        before = *best;
        *best = finer;
    }
}
