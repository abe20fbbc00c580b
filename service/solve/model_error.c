/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/model_error.h"

#include <math.h>

#include "impact/tangent_group.h"
#include "solve/askew.h"
#include "solve/contact_model.h"
#include "solve/fewer.h"
#include "solve/loss.h"
#include "solve/model_perturbed.h"
#include "solve/outcome.h"
#include "solve/unstated.h"
#include "solve/validity.h"

/* Change of e by a unit of the stiffness's logarithm, of a single contact: by the share s of the
 * energy that vibrates, at most LOST s + SWUNG sqrt(s) of 97 in 100 random bars (waves that leave;
 * a mode that the contact catches in its swing). */
static const double LOST = 0.3;
static const double SWUNG = 0.2;
/* Change of a sub-impact's impulse up to which first order says what it makes of e: within a
 * quarter of what solutions beside it (model_perturbed.h) say of 350 random sequences. */
static const double STRAIN = 0.05;
/* The same of a group, against the whole of which grazes count little: what is stated is within a
 * tenth of what solutions beside say of nine in ten of 115 random groups, and below four fifths of
 * it of six in a hundred, which lose or gain a sub-impact there. */
static const double STRAIN_GROUP = 0.2;
/* The same for second order, of a single contact: of 103 random sequences with more than the first
 * it says no less than 0.7 of what solutions beside say but for one, of nine in ten no more than
 * 1.5 of it. It grows without bound where a contact is but grazed. */
static const double STRAIN_CURVED = 0.5;
/* Expected change, by what is left out of the modes, from which on it is not followed: beyond it
 * half of the sequences are too sensitive for that. */
static const double FOLLOWED = 0.7;

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
    double share = (energy->vibration + energy->damping) / energy->available;
    share = fmin(fmax(share, 0.0), 1.0); /* NAN: nothing was available */
    return LOST * share + SWUNG * sqrt(share);
}

/* Least restitution that lost energy is counted against. */
static const double LEAST_REBOUND = 0.1;

/* Change of e by the energy that goes into waves of a bar's whole body. */
static double by_waves(const struct model_margin *margin, size_t c)
{
    const struct problem *problem = margin->problem;
    const struct impact_outcome *outcome = &margin->solution->outcome;
    double compression = problem->impulse_compression[c];
    double lost =
        model_deviation_waves(problem, margin->solution->assembly, outcome, c, &margin->blow[c]);
    if (!(compression > 0.0) || lost == 0.0)
        return 0.0;
    double rebound = fmax(fabs(outcome_restitution(problem, outcome, c)), LEAST_REBOUND);
    double w = problem->w[c * (problem->contact_count + 1)];
    return lost / (rebound * compression * compression * w);
}

static double of_contact(const struct model_margin *margin, size_t c)
{
    double spring =
        sensitivity(margin) * model_deviation_stiffness(&margin->deviation[c], &margin->blow[c]);
    double flow = margin->deviation[c].yield *
                  outcome_rebound(margin->problem, &margin->solution->outcome, c);
    double ringing = model_deviation_ringing(margin->problem, c, &margin->blow[c]);
    double bent = askew_loss(margin->problem, c, margin->blow[c].duration);
    return hypot(hypot(spring, flow), ringing) + bent + by_waves(margin, c);
}

/* As if there were one contact after which the bodies part. */
static void single(const struct model_margin *margin, struct model_error *error)
{
    const struct impact_outcome *outcome = &margin->solution->outcome;
    double waves = validity_wave_loss(margin->problem);
    error->restitution = 0.0;
    for (size_t c = 0; c < margin->problem->contact_count; c++) {
        double change = of_contact(margin, c);
        error->restitution = fmax(error->restitution, change);
        error->impulse[c] = (change + waves) * outcome_impulse_scale(margin->problem, outcome, c);
    }
    error->restitution += waves;
}

/* All of what is uncertain of a contact, as it makes it stiffer or softer. */
static struct tangent_source source_of(const struct model_margin *margin, size_t c, double sign)
{
    const struct model_deviation *deviation = &margin->deviation[c];
    struct model_stiffening stiffer = model_deviation_stiffening(deviation, &margin->blow[c]);
    return (struct tangent_source){.force = sign * stiffer.force,
                                   .compliance = sign * stiffer.compliance};
}

/* What all of it together, stiffer, does by the orders along the answer. */
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
    struct tangent_source source[2][PERCUSS_MAX_CONTACTS];
    struct tangent_group tangent[2];
    struct scene scene;
    for (size_t c = 0; c < problem->contact_count; c++) {
        source[0][c] = source_of(margin, c, 1.0);
        source[1][c] = source_of(margin, c, c % 2 ? -1.0 : 1.0);
    }
    if (!fewer_modes(problem, solution->scene, &solution->outcome, FEWER_FIRST_ORDER, &scene))
        return PERCUSS_INTERNAL;
    const struct tangent_group_task task = {&scene, solution->log, 2, {source[0], source[1]}};
    enum percuss_status status = tangent_group_follow(&task, problem->arena, pace, tangent);
    if (status)
        return status;
    orders->first = orders->second = 0.0;
    orders->strain = fmax(tangent[0].strain, tangent[1].strain);
    for (size_t c = 0; c < problem->contact_count; c++) {
        double compression = problem->impulse_compression[c];
        double change = fmax(fabs(tangent[0].impulse[c]), fabs(tangent[1].impulse[c]));
        orders->impulse[c] = change;
        if (compression > 0.0)
            orders->first = fmax(orders->first, change / compression);
    }
    return PERCUSS_OK;
}

/* Along the answer, as the search for modes left it or made now. NULL: out of memory. */
static struct tangent_path *find_path(const struct model_margin *margin)
{
    const struct solution *solution = margin->solution;
    struct scene scene;
    if (solution->path)
        return solution->path;
    if (!fewer_modes(margin->problem, solution->scene, &solution->outcome, FEWER_FIRST_ORDER,
                     &scene))
        return NULL;
    return tangent_path_create(&scene, solution->log, margin->problem->arena);
}

static enum percuss_status follow(const struct model_margin *margin, struct tangent_path *path,
                                  bool curved, struct pace *pace, struct by_orders *orders)
{
    struct tangent_source source = source_of(margin, 0, 1.0);
    struct tangent tangent;
    source.curved = curved;
    enum percuss_status status = tangent_follow(path, &source, pace, &tangent);
    double compression = margin->problem->impulse_compression[0];
    if (status)
        return status;
    orders->first = tangent.impulse / compression;
    orders->second = tangent.curvature / compression;
    orders->strain = tangent.strain;
    return PERCUSS_OK;
}

/* Of a single contact: second order at once where what is left out of the modes lets expect that
 * first order is not enough. */
static enum percuss_status single_by_order(const struct model_margin *margin, struct pace *pace,
                                           struct by_orders *orders, double *change)
{
    const struct solution *solution = margin->solution;
    double all = model_deviation_stiffness(&margin->deviation[0], &margin->blow[0]);
    double expected = solution->modes.strained * sensitivity(margin) * all;
    if (!(all > 0.0) || expected > FOLLOWED)
        return PERCUSS_OK;
    bool bends = solution->scene->laws[0].operations->three_halves;
    bool curved = bends && expected > STRAIN;
    struct tangent_path *path = find_path(margin);
    enum percuss_status status = follow(margin, path, curved, pace, orders);
    if (!status && !curved && bends && orders->strain > STRAIN && orders->strain <= STRAIN_CURVED) {
        curved = true;
        status = follow(margin, path, curved, pace, orders);
    }
    if (!status && orders->strain <= (curved ? STRAIN_CURVED : STRAIN))
        *change = fabs(orders->first) + 0.5 * fabs(orders->second);
    return status;
}

/* What e may change by, where first or second order tells it; INFINITY: neither does. */
static enum percuss_status by_order(const struct model_margin *margin, struct pace *pace,
                                    struct by_orders *orders, double *change)
{
    *change = INFINITY;
    if (!margin->solution->log)
        return PERCUSS_OK;
    if (margin->problem->contact_count == 1)
        return single_by_order(margin, pace, orders, change);
    enum percuss_status status = follow_group(margin, pace, orders);
    if (!status && orders->strain <= STRAIN_GROUP)
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
        return model_perturbed_find(margin, pace, &error->restitution, error->impulse);
    error->restitution = fmax(error->restitution, MODEL_PERTURBED_BETWEEN * change);
    for (size_t c = 0; margin->problem->contact_count > 1 && c < margin->problem->contact_count;
         c++)
        error->impulse[c] = fmax(error->impulse[c], MODEL_PERTURBED_BETWEEN * orders.impulse[c]);
    return PERCUSS_OK;
}

enum percuss_status model_error_find(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, struct model_error *error)
{
    /* what of each contact is uncertain */
    size_t n = problem->contact_count;
    struct model_margin margin = {
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
    /* as of one blow, and of a sequence of them */
    enum percuss_status status = PERCUSS_OK;
    single(&margin, error);
    if (is_sequence(&margin))
        status = amplify(&margin, pace, error);
    /* what the materials lose of themselves, and what metals would of whose yield nothing is said
     */
    double loss = loss_worst(problem, &solution->outcome);
    double yield = unstated_worst(problem, &solution->outcome);
    double range = outcome_range(problem, &solution->outcome);
    double elastic = fmin(error->restitution + loss, range);
    error->restitution = fmin(error->restitution + loss + yield, range);
    error->yield = error->restitution - elastic;
    for (size_t c = 0; c < n; c++)
        error->impulse[c] += (loss + yield) * outcome_impulse_scale(problem, &solution->outcome, c);
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
