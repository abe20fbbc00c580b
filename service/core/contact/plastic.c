/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/plastic.h"

#include <math.h>

/* A stored force that differs from the curve's by less is this law's own, rounded. */
static const double SAME_FORCE = 1e-9;

/* Range of indentations of the unloading branch. */
static double span_of(const struct contact_history *history)
{
    return history->max_indentation - history->dent;
}

double plastic_force(const struct contact_law *law, double indentation, double *stiffness)
{
    if (!(indentation > 0.0)) {
        *stiffness = 0.0;
        return 0.0;
    }
    const struct contact_history *history = &law->history;
    double span = span_of(history);
    if (indentation >= span)
        return law->operations->curve->force(law, indentation + history->dent, stiffness);
    double share = law->operations->curve->branch(law, indentation / span, stiffness);
    *stiffness *= history->max_force / span;
    return history->max_force * share;
}

/* Energy under the unloading branch from 0 to the share x, J. */
static double branch_energy(const struct contact_law *law, double x)
{
    double span = span_of(&law->history);
    return span > 0.0 ? law->history.max_force * span * law->operations->curve->branch_work(law, x)
                      : 0.0;
}

double plastic_stored(const struct contact_law *law, double indentation)
{
    if (!(indentation > 0.0))
        return 0.0;
    const struct contact_history *history = &law->history;
    const struct plastic_curve *curve = law->operations->curve;
    double span = span_of(history);
    if (indentation < span)
        return branch_energy(law, indentation / span);
    double beyond = curve->work(law, indentation + history->dent);
    return span > 0.0
               ? branch_energy(law, 1.0) + (beyond - curve->work(law, history->max_indentation))
               : beyond;
}

/* Newton's method for the logarithms, from where the force is nearly a power of the indentation. */
double plastic_indentation(const struct contact_law *law, double force)
{
    double d = fmin(contact_law_limit(law), 1e-6);
    for (int i = 0; i < 100; i++) {
        double stiffness;
        double here = plastic_force(law, d, &stiffness);
        double change = log(force / here) * here / (stiffness * d);
        d *= exp(fmax(-3.0, fmin(change, 3.0)));
        if (!(fabs(change) > 1e-15))
            break;
    }
    return d;
}

double contact_law_limit(const struct contact_law *law)
{
    if (!law->operations->curve)
        return INFINITY;
    return fmax(law->operations->curve->yield(law), law->history.max_indentation) -
           law->history.dent;
}

double contact_law_unloading(const struct contact_law *law)
{
    double slope;
    if (!(law->history.max_force > 0.0))
        return 0.0;
    law->operations->curve->branch(law, 1.0, &slope);
    return slope * law->history.max_force / span_of(&law->history);
}

/* To begin with where a law does not say where it yields, m. */
static const double FIRST_DEPTH = 1e-6;

double contact_law_depth(const struct contact_law *law, double work)
{
    const struct plastic_curve *curve = law->operations->curve;
    double d = curve ? curve->yield(law) : 0.0;
    d = d > 0.0 && isfinite(d) ? d : FIRST_DEPTH;
    for (int i = 0; i < 60; i++) {
        double slope;
        double here = curve ? curve->work(law, d) : law->operations->stored(law, d);
        double force =
            curve ? curve->force(law, d, &slope) : law->operations->force(law, d, &slope);
        double change = log(work / here) * here / (force * d);
        d *= exp(fmax(-3.0, fmin(change, 3.0)));
        if (!(fabs(change) > 1e-9))
            break;
    }
    return d;
}

/* The history after a largest depth on the virgin curve. */
static struct contact_history history_of(const struct contact_law *law, double depth)
{
    const struct plastic_curve *curve = law->operations->curve;
    double slope;
    return (struct contact_history){
        .max_indentation = depth,
        .max_force = curve->force(law, depth, &slope),
        .dent = curve->residual(law, depth),
        .contact_radius = curve->radius(law, depth),
    };
}

struct contact_law contact_law_after(const struct contact_law *law, double depth)
{
    struct contact_law after = *law;
    if (depth > law->history.max_indentation)
        after.history = history_of(law, depth);
    return after;
}

double contact_law_yield(struct contact_law *law, double indentation)
{
    double before = plastic_stored(law, indentation);
    law->history = history_of(law, indentation + law->history.dent);
    return before - branch_energy(law, 1.0);
}

void contact_law_remember(struct contact_law *law, const struct contact_history *history)
{
    const struct plastic_curve *curve = law->operations->curve;
    law->history = (struct contact_history){0};
    if (!curve || !(history->max_force > 0.0))
        return;
    double slope;
    double here = curve->force(law, history->max_indentation, &slope);
    if (fabs(here - history->max_force) <= SAME_FORCE * here) {
        law->history = *history;
        return;
    }
    double depth = plastic_indentation(law, history->max_force);
    if (depth > curve->yield(law))
        law->history = history_of(law, depth);
}

struct contact_law contact_law_rescaled(const struct contact_law *law, double force, double yield)
{
    struct contact_law rescaled = *law;
    struct contact_history history = law->history;
    history.max_force *= force;
    law->operations->rescale(&rescaled, force, yield);
    contact_law_remember(&rescaled, &history);
    return rescaled;
}
