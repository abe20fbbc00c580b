/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/unstated.h"

#include <math.h>
#include <string.h>

#include "contact/law_closed_form.h"
#include "percuss/plausible.h"
#include "solve/contact_model.h"
#include "solve/outcome.h"

/* Yield strain that most metals have or exceed: what the model's error holds. */
static const double ORDINARY = 0.002;
/* And that hardly any exceeds: hardened steels yield at 2 GPa. */
static const double STRONGEST = 0.01;
/* A metal that would yield later than so many times the pressure at which the other body flows
 * stays elastic (contact_family_both_yield). */
static const double HARD_ENOUGH = 2.0;
/* Share of a sub-impact's rebound from which on the next ones are others altogether. */
static const double OTHERS = 0.05;

static bool is_unstated(const struct problem *problem, size_t contact, int which)
{
    if (!problem_body(problem, contact, which)->yield_unstated)
        return false;
    const struct material *material = problem_material(problem, contact, which);
    return isinf(material->yield) && plausible_metal(material->young, material->density);
}

/* Hertz's peak pressure at which the body yields: if it is ordinary where that is not stated. */
static double bears(const struct problem *problem, size_t contact, int which)
{
    struct material material = *problem_material(problem, contact, which);
    if (is_unstated(problem, contact, which))
        material.yield = ORDINARY * material.young;
    return closed_form_pressure(&material);
}

/* What the contact gives back by itself, of `times` the energy at which the softer body yields. */
static double given_back(const struct problem *problem, size_t contact, double pressure,
                         double times)
{
    double modulus = problem->hertz[contact].effective_modulus;
    return closed_form_restitution(times, pressure / HERTZ_FIRST_YIELD / modulus);
}

bool unstated_any(const struct problem *problem, size_t contact)
{
    return is_unstated(problem, contact, 0) || is_unstated(problem, contact, 1);
}

struct unstated_blow unstated_blow_of(const struct problem *problem,
                                      const struct impact_outcome *outcome, size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    double compression = problem->impulse_compression[contact];
    struct unstated_blow blow = {.force = outcome_peak_force(outcome, contact),
                                 .rebound = outcome_rebound(problem, outcome, contact),
                                 .range = outcome_range(problem, outcome)};
    if (contact_model_yielded(problem, outcome, contact))
        blow.depth = outcome->laws[contact].history.max_indentation /
                     problem->contact_model.choices[contact].yield;
    /* in a group the other contacts decide what comes first */
    double first = track->count > 0 && problem->contact_count == 1 ? track->list[0].impulse : 0.0;
    if (compression > 0.0)
        blow.later = (track->impulse - first) / compression;
    return blow;
}

double unstated_holds_above(const struct problem *problem, size_t contact, double force)
{
    if (!unstated_any(problem, contact))
        return 0.0;
    /* no more than the other body lets it become */
    double pressure = hertz_peak_pressure(&problem->hertz[contact], force);
    for (int which = 0; which < 2; which++)
        if (!is_unstated(problem, contact, which))
            pressure = fmin(pressure, HARD_ENOUGH * bears(problem, contact, which));
    return pressure / HERTZ_FIRST_YIELD;
}

double unstated_change(const struct problem *problem, size_t contact,
                       const struct unstated_blow *blow)
{
    if (!unstated_any(problem, contact))
        return 0.0;
    /* as the answer takes it, and with yields for all */
    double now = INFINITY, then = INFINITY;
    for (int which = 0; which < 2; which++) {
        double pressure = bears(problem, contact, which);
        then = fmin(then, pressure);
        if (!is_unstated(problem, contact, which))
            now = fmin(now, pressure);
    }
    /* energies over those of yield; that of Hertz's law goes by the fifth power of the pressure */
    double peak = hertz_peak_pressure(&problem->hertz[contact], blow->force);
    if (!(then < now) || !(peak > then || blow->depth > 1.0))
        return 0.0;
    bool flowed = blow->depth > 1.0;
    double before = flowed ? pow(blow->depth, 2.5) : 1.0;
    double after = flowed ? before * pow(now / then, 5.0) : pow(peak / then, 5.0);
    double back = given_back(problem, contact, then, after);
    if (flowed)
        back /= given_back(problem, contact, now, before);
    double share = fmax(1.0 - back, 0.0);
    return fmin(share * blow->rebound + fmin(share / OTHERS, 1.0) * blow->later, blow->range);
}

double unstated_worst(const struct problem *problem, const struct impact_outcome *outcome)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        if (!unstated_any(problem, c))
            continue;
        struct unstated_blow blow = unstated_blow_of(problem, outcome, c);
        worst = fmax(worst, unstated_change(problem, c, &blow));
    }
    return worst;
}

static void add_stress(struct text *text, double stress)
{
    text_add_number(text, stress / 1e6, stress < 1e9 ? 3 : 4);
}

void unstated_explain(const struct problem *problem, const struct impact_outcome *outcome,
                      struct text *text)
{
    double above = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        if (unstated_any(problem, c))
            above = fmax(above, unstated_holds_above(problem, c, outcome_peak_force(outcome, c)));
    if (!(above > 0.0))
        return;
    text_add(text, "; holds for metals that yield above ");
    add_stress(text, above);
    text_add(text, " MPa");
}

/* Whose yield is not stated, and the softest of them. Two bodies of one material are one omission.
 */
static const struct material *add_names(const struct problem *problem, size_t contact, double above,
                                        struct text *text)
{
    const struct material *softest = NULL;
    double lowest = INFINITY;
    for (int which = 0; which < 2; which++) {
        const struct material *material = problem_material(problem, contact, which);
        double pressure = bears(problem, contact, which);
        bool said = softest && strcmp(softest->name, material->name) == 0;
        if (said || !is_unstated(problem, contact, which) ||
            !(pressure < HERTZ_FIRST_YIELD * above))
            continue;
        text_add(text, softest ? " and " : "");
        text_add(text, material->name);
        text_add(text, " (");
        text_add(text, problem_body(problem, contact, which)->id);
        text_add(text, ")");
        softest = pressure < lowest ? material : softest;
        lowest = fmin(lowest, pressure);
    }
    return softest;
}

/* Put together by pieces: it is said of many answers, and formats take longer than short solves. */
void unstated_find(const struct problem *problem, size_t contact, const struct unstated_blow *blow,
                   struct warnings *warnings)
{
    double change = unstated_change(problem, contact, blow);
    struct text text;
    if (!(change > problem->tolerance) || !warnings_begin(warnings, WARNING_UNSTATED, &text))
        return;
    double above = unstated_holds_above(problem, contact, blow->force);
    text_add(&text, "contacts[");
    text_add_count(&text, contact);
    text_add(&text, "]: no yield (or none) is stated of ");
    const struct material *softest = add_names(problem, contact, above, &text);
    text_add(&text, ": the answer holds for metals that yield above ");
    add_stress(&text, above);
    text_add(&text, " MPa");
    if (softest && above > STRONGEST * softest->young) {
        text_add(&text, ", which hardly any does (young/100: ");
        add_stress(&text, STRONGEST * softest->young);
        text_add(&text, " MPa)");
    }
    text_add(&text, "; at young/500 the restitution is off by up to ");
    text_add_number(&text, change, 2);
}
