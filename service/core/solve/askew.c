/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/askew.h"

#include <math.h>

#include "model/bar.h"

/* Part of a force across the axis, and of the radius beside it, that is rounding of the pose: it
 * takes 1e-9 of the energy. */
static const double ALONG = 1e-5;
/* Modes that are summed: their shares fall with the fourth power of the frequency, which grows with
 * the square of the number, once they are quicker than the contact. */
enum { MODES = 24 };

/* The beam that a rod is; its fixed end is clamped. False: the body is none, or its section has no
 * shear factor. */
static bool beam_of(const struct body *rod, struct body *beam)
{
    struct fault fault;
    if (rod->kind != &rod_kind)
        return false;
    *beam = *rod;
    beam->kind = &beam_kind;
    beam->theory = THEORY_TIMOSHENKO;
    beam->shear_rule = SHEAR_ABSENT;
    return body_complete(beam, &fault) == PERCUSS_OK;
}

/* Energy of a mode after a force like half a sine, over that after a blow of the same impulse:
 * cos^2(w T/2) / (1 - (w T/pi)^2)^2, here 1 where that is about 1, and then its envelope. */
static double spectrum_of_half_sine(double omega, double duration)
{
    double x = omega * duration / M_PI;
    return x > 1.5 ? 1.0 / ((1.0 - x * x) * (1.0 - x * x)) : 1.0;
}

/* Sum over the modes of the squared participations, 1/kg: twice the energy of bending by a unit
 * impulse. */
static double bending(const struct problem *problem, const struct body *beam,
                      const struct site_load *load, double duration)
{
    double sum = 0.0;
    for (size_t family = BAR_BENDING_Y; family <= BAR_BENDING_Z; family++) {
        if (!load->family[family].acts)
            continue;
        struct modal_family *modes = modal_family_create(beam, family, MODES);
        if (!modes)
            problem->arena->lacks = true;
        for (size_t k = 0; modes && k < modes->count; k++) {
            double phi = modal_participation(beam, modes, k, &load->family[family]);
            sum += phi * phi * spectrum_of_half_sine(modes->omega[k], duration);
        }
        modal_family_free(modes);
    }
    return sum;
}

/* How far a force is off the axis of a rod: sine of the angle, and m beside it where its line
 * leaves the full section. False: the body is no rod, or the force is on its axis. */
static bool is_askew(const struct problem *problem, size_t contact, int which, double *across,
                     double *beside)
{
    const struct contact_side *side = &problem->sides[contact][which];
    const struct body *body = problem_body(problem, contact, which);
    const double *point = side->site.point, *along = side->direction;
    if (body->kind != &rod_kind)
        return false;
    double ahead = (bar_cap_section(body, &side->site) - point[0]) / along[0];
    *across = hypot(along[1], along[2]);
    *beside = hypot(point[1] + ahead * along[1], point[2] + ahead * along[2]);
    return *across > ALONG || *beside > ALONG * body->radius;
}

/* Of one rod, as a part of W. */
static double askew_share(const struct problem *problem, size_t contact, int which, double duration)
{
    const struct contact_side *side = &problem->sides[contact][which];
    struct body beam;
    double across, beside;
    if (!is_askew(problem, contact, which, &across, &beside) ||
        !beam_of(problem_body(problem, contact, which), &beam))
        return 0.0;
    struct site_load load = site_load_make(&beam, &side->site, side->direction, false);
    return bending(problem, &beam, &load, duration) /
           problem->w[contact * (problem->contact_count + 1)];
}

/* Of the energy of approach the impulse 1 + e leaves (1 + e)^2 S in the bending: e^2 = 1 - (1 +
 * e)^2 S; its root above -1 is (1 - S)/(1 + S). */
double askew_loss(const struct problem *problem, size_t contact, double duration)
{
    double share = 0.0;
    for (int which = 0; which < 2 && duration > 0.0; which++)
        share += askew_share(problem, contact, which, duration);
    return 2.0 * share / (1.0 + share);
}

void askew_find(const struct problem *problem, size_t contact, double duration,
                struct warnings *warnings)
{
    double loss = askew_loss(problem, contact, duration);
    for (unsigned which = 0; which < 2 && loss > problem->tolerance; which++) {
        double across, beside;
        if (is_askew(problem, contact, (int)which, &across, &beside))
            warnings_add(warnings, WARNING_BENDING + which,
                         "contacts[%zu]: the force, %.2g degrees askew and %.2g m beside the axis, "
                         "bends %s; a rod has longitudinal waves only: the restitution is lower by "
                         "about %.2g (shape: beam has both, with tip_radius)",
                         contact, asin(fmin(across, 1.0)) * 180.0 / M_PI, beside,
                         problem_body(problem, contact, (int)which)->id, loss);
    }
}
