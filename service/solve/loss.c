/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/loss.h"

#include <math.h>

#include "contact/hertz.h"
#include "solve/outcome.h"

/* No metal, glass or ceramic that bodies are made of is softer (lead: 16 GPa): what is are
 * plastics, rubber, woods, foams. */
static const double SOFT = 10e9;
/* The least loss factor of those: 0.01 to 2 (Gerdeen, Lord, Rorrer, Engineering Design with
 * Polymers and Composites, chapter 12). */
static const double LEAST = 0.01;

/* Of the contact's indentation, what is in one of its bodies. */
static double share_of(const struct problem *problem, size_t contact, int which)
{
    const struct material *a = problem_material(problem, contact, 0);
    const struct material *b = problem_material(problem, contact, 1);
    const struct material *own = which == 0 ? a : b;
    return (1.0 - own->poisson * own->poisson) / own->young * hertz_effective_modulus(a, b);
}

/* 1 - exp(-pi eta/2) of a rebound. */
static double lost(double rebound, double loss_factor)
{
    return loss_factor > 0.0 ? rebound * -expm1(-M_PI_2 * loss_factor) : 0.0;
}

/* The body's part of the contact's loss factor, 0 where none is stated. */
static double stated(const struct problem *problem, size_t contact, int which)
{
    double loss_factor = problem_body(problem, contact, which)->loss_factor;
    return isnan(loss_factor) ? 0.0 : share_of(problem, contact, which) * loss_factor;
}

double loss_of_contact(const struct problem *problem, size_t contact, double rebound)
{
    return lost(rebound, stated(problem, contact, 0) + stated(problem, contact, 1));
}

double loss_worst(const struct problem *problem, const struct impact_outcome *outcome)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        worst = fmax(worst, loss_of_contact(problem, c, outcome_rebound(problem, outcome, c)));
    return worst;
}

/* Of both bodies together more than the tolerance: who has half of it or more. */
static void find_stated(const struct problem *problem, size_t contact, double rebound,
                        struct warnings *warnings)
{
    double both = stated(problem, contact, 0) + stated(problem, contact, 1);
    double whole = lost(rebound, both);
    for (unsigned which = 0; which < 2 && whole > problem->tolerance; which++) {
        const struct body *body = problem_body(problem, contact, (int)which);
        if (stated(problem, contact, (int)which) >= 0.5 * both)
            warnings_add(
                warnings, WARNING_LOSS + which,
                "contacts[%zu]: what %s loses of itself in the contact (loss_factor %.3g) is not "
                "in the answer: the restitution is lower by about %.2g; the tolerance is %.2g",
                contact, body->id, body->loss_factor, whole, problem->tolerance);
    }
}

static void find_unstated(const struct problem *problem, size_t contact, double rebound,
                          struct warnings *warnings)
{
    for (unsigned which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, contact, (int)which);
        double young = problem_material(problem, contact, (int)which)->young;
        if (!isnan(body->loss_factor) || !(young < SOFT))
            continue;
        double least = lost(rebound, share_of(problem, contact, (int)which) * LEAST);
        if (least > problem->tolerance)
            warnings_add(warnings, WARNING_LOSS + which,
                         "contacts[%zu]: materials as soft as that of %s (young %.3g Pa) lose "
                         "energy of themselves, of the restitution %.2g or more: it is not in the "
                         "answer; a loss_factor is not stated",
                         contact, body->id, young, least);
    }
}

void loss_find(const struct problem *problem, size_t contact, double rebound,
               struct warnings *warnings)
{
    find_stated(problem, contact, rebound, warnings);
    find_unstated(problem, contact, rebound, warnings);
}
