/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/law.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/family.h"
#include "contact/hertz.h"
#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "percuss/plausible.h"
#include "solve/contact_model.h"
#include "solve/error/calibration.h"
#include "solve/outcome.h"

/* ---- Laws that yield ---- */

/* Restitution of the contact alone, from a depth: the root of the part of the work that comes back.
 */
static double restitution_from(const struct contact_law *law, double depth, double work)
{
    struct contact_law used = *law;
    if (!(depth > law->operations->curve->yield(law)))
        return 1.0;
    used.history = (struct contact_history){0};
    contact_law_yield(&used, depth);
    return sqrt(used.operations->stored(&used, contact_law_limit(&used)) / work);
}

/* Restitution of the contact alone with so many times the yield stress, over that of the law from a
 * depth: the same work is taken up. */
static double rebound_with(const struct contact_law *law, double depth, double yield)
{
    struct contact_law other = contact_law_rescaled(law, 1.0, yield);
    double work = law->operations->curve->work(law, depth);
    return restitution_from(&other, contact_law_depth(&other, work), work) /
           restitution_from(law, depth, work);
}

/* How much less, or more, of the same work the contact gives back by the family. */
static double against_family(const struct contact_law *law, const struct contact_law *family,
                             double depth)
{
    double work = law->operations->curve->work(law, depth);
    double other = contact_law_depth(family, work);
    if (!(other > family->operations->curve->yield(family)))
        return 0.0;
    double e = restitution_from(law, depth, work);
    return fabs(restitution_from(family, other, work) / e - 1.0);
}

/* The closed form where there is no family to compare it with: it springs back by too little the
 * deeper, the more the metal hardens and the more of the compliance is the other body's. Fitted to
 * that comparison so that 96 of 100 random pairs (2600, 45 to 400 GPa, yields of 60 to 700 MPa,
 * hardening 0 to 0.3, 2 to 1000 times the indentation of yield) are no further off; the median is
 * 0.75 of it. */
static double by_closed_form(double depth, double hardening, double share)
{
    double way = log(larger(depth, 1.0));
    return expm1(0.031 * pow(way, 1.8) * (1.0 + 4.0 * pow(hardening, 0.65)) * exp(-0.9 * share));
}

/* Small strains and parabolas. Of a sphere pressed flat the mean pressure falls from 2.84 yields by
 * exp(-0.82 (a/R)^(-0.7)) of it (Jackson and Green, J. Tribology 127 (2005) 343; of a flat that is
 * indented it falls less), and e grows with the hardness to the power 5/8 (Johnson, Contact
 * Mechanics, 1985, section 11.5). */
static double by_size(double ratio)
{
    return ratio > 0.0 ? 0.625 * exp(-0.82 * pow(ratio, -0.7)) : 0.0;
}

/* Tables are of flat surfaces; a ball that yields bears less and springs back less, both by the
 * first power of w = (contact radius / its own radius). Its free surface falls away under the edge
 * by the angle w: of the mean pressure of slip lines, 2 k (1 + pi/2), 2 k w is lost (Johnson 1985,
 * section 6.2), as far as yield and not hardening bears it, at Tabor's strain of 0.2 w. And the
 * pole approaches the centre by F ((1 + nu)/4 + (1 - nu^2)/2) / (pi E R) less than that of a
 * half-space by the depth (Tatara, J. Eng. Mater. Technol. 113 (1991) 285, at small contacts): so
 * much less of F (1 - nu^2)/(2 E a) is stored, and e^2 with it, by the ball's share of the
 * compliance. */
static double lost_pressure(const struct material *soft, double w)
{
    double borne = soft->yield / (soft->yield + 0.2 * w * soft->tangent);
    return 0.625 * borne * w / (1.0 + M_PI_2);
}

static double lost_storage(const struct material *soft, double share, double w)
{
    return 0.5 * share * w * M_2_PI * (0.5 + 0.25 / (1.0 - soft->poisson));
}

/* Root mean square of a surface's principal curvatures: 1/R of a sphere. */
static double roundness(const struct site *site)
{
    double squares = 0.0;
    for (int i = 0; i < 9; i++)
        squares += site->curvature[i] * site->curvature[i];
    return sqrt(0.5 * squares);
}

/* Share of one of its bodies in the compliance of a contact. */
static double compliance_share(const struct material *const materials[2], int side)
{
    double own[2];
    for (int i = 0; i < 2; i++)
        own[i] = (1.0 - materials[i]->poisson * materials[i]->poisson) / materials[i]->young;
    return own[side] / (own[0] + own[1]);
}

/* Of the balls that flow: that with the smaller radius loses the pressure of both. Balls that stay
 * elastic store less as well. */
static double by_roundness(const struct problem *problem, size_t contact, double contact_radius)
{
    const struct contact_choice *choice = &problem->contact_model.choices[contact];
    const struct contact_side *sides = problem->sides[contact];
    const struct material *m[2] = {problem_material(problem, contact, 0),
                                   problem_material(problem, contact, 1)};
    bool both = contact_family_both_yield(m[0], m[1]);
    double pressure = 0.0, stored = 0.0;
    for (int i = 0; i < 2; i++) {
        double w = contact_radius * roundness(&sides[i].site);
        if (i == choice->side || both)
            pressure = larger(lost_pressure(m[i], w), pressure);
        stored += lost_storage(m[i], compliance_share(m, i), w);
    }
    return pressure + stored;
}

/* An elliptic contact yields like the sphere of equal stiffness under the ellipse's peak pressure.
 * Flowing throughout, it has another area (law_closed_form.h); where flow begins it bears up
 * to 1.79 yields of peak pressure, a circle 1.6 (hertz.h). */
static double by_ellipse(const struct hertz_contact *hertz)
{
    const double *curvature = hertz->curvature;
    if (hertz->axis_ratio >= HERTZ_CIRCULAR_RATIO)
        return 0.0;
    double radius = 0.5 / sqrt(curvature[0] * curvature[1]);
    double area = log(radius / closed_form_radius(hertz) * hertz_pressure_ratio(hertz));
    double slender = 1.0 - hertz->axis_ratio;
    return 0.625 * (fabs(area) + slender * slender * log(1.79 / HERTZ_FIRST_YIELD));
}

/* The table itself: a family's is one between others. */
static double by_table(const struct contact_choice *choice, double depth)
{
    double beyond = depth / contact_law_table_range(&choice->plastic);
    double error = beyond > 1.0 ? LAW_BEYOND * log10(beyond) : 0.0;
    error += LAW_DEEP * log10(larger(depth / (30.0 * choice->yield), 1.0));
    if (!choice->family)
        return error + LAW_OWN_TABLE + contact_curves_error(choice->plastic.table);
    return error + LAW_FAMILY + LAW_OUTSIDE * choice->outside + (choice->both ? LAW_FAMILY : 0.0);
}

void law_error_parts(const struct problem *problem, size_t contact,
                     const struct contact_history *history, double parts[LAW_ERROR_COUNT])
{
    const struct contact_choice *choice = &problem->contact_model.choices[contact];
    /* size and shape */
    const struct material *m[2] = {problem_material(problem, contact, 0),
                                   problem_material(problem, contact, 1)};
    const struct material *soft = m[choice->side];
    double hardening = soft->tangent / soft->young;
    parts[LAW_ERROR_SIZE] =
        by_size(history->contact_radius / closed_form_radius(&problem->hertz[contact])) +
        by_roundness(problem, contact, history->contact_radius) +
        by_ellipse(&problem->hertz[contact]);
    /* the one rate of strain in the place of each point's */
    const struct contact_rate *rate = &problem->contact_model.rates[contact];
    double depth = history->max_indentation;
    parts[LAW_ERROR_RATE] = 0.0;
    if (rate->fast > 1.0)
        parts[LAW_ERROR_RATE] = fmax(fabs(rebound_with(&choice->plastic, depth, rate->slow) - 1.0),
                                     fabs(rebound_with(&choice->plastic, depth, rate->fast) - 1.0));
    /* the law itself, against its reference */
    if (choice->tabulated)
        parts[LAW_ERROR_LAW] = by_table(choice, history->max_indentation);
    else if (!choice->compared.operations)
        parts[LAW_ERROR_LAW] =
            LAW_FAMILY + by_closed_form(history->max_indentation / choice->yield, hardening,
                                        compliance_share(m, choice->side));
    else
        parts[LAW_ERROR_LAW] = LAW_FAMILY + against_family(&choice->plastic, &choice->compared,
                                                           history->max_indentation);
}

/* Of a contact that yielded; nothing of one that did not. */
static void find_parts(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t contact, double parts[LAW_ERROR_COUNT])
{
    memset(parts, 0, LAW_ERROR_COUNT * sizeof *parts);
    if (contact_model_yielded(problem, outcome, contact))
        law_error_parts(problem, contact, &outcome->laws[contact].history, parts);
}

double law_error(const struct problem *problem, const struct impact_outcome *outcome,
                 size_t contact)
{
    double parts[LAW_ERROR_COUNT];
    find_parts(problem, outcome, contact, parts);
    return parts[LAW_ERROR_SIZE] + parts[LAW_ERROR_LAW] + parts[LAW_ERROR_RATE];
}

const char *law_error_reason(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact)
{
    const struct contact_choice *choice = &problem->contact_model.choices[contact];
    double parts[LAW_ERROR_COUNT];
    find_parts(problem, outcome, contact, parts);
    if (parts[LAW_ERROR_RATE] > larger(parts[LAW_ERROR_SIZE], parts[LAW_ERROR_LAW]))
        return "the rate of strain, and with it the yield stress, is known roughly";
    if (parts[LAW_ERROR_SIZE] > parts[LAW_ERROR_LAW])
        return "the dent is too large for small strains";
    if (!choice->tabulated)
        return choice->compared.operations ? "the closed form against tables of finite elements"
                                           : "the closed form without tables to compare with";
    return "the tables end before these materials or this depth";
}

/* To first order, by the slope between this yield stress and a slightly larger one. */
double law_error_yield(const struct contact_law *law, double depth, double share)
{
    const double step = 0.05;
    const double most = 3.0;
    double slope = log(rebound_with(law, depth, 1.0 + step)) / log1p(step);
    return slope > 0.0 ? smaller(exp(share / slope), most) : most;
}

double law_error_worst(const struct problem *problem, const struct impact_outcome *outcome)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        worst = larger(law_error(problem, outcome, c), worst);
    return worst;
}

/* ---- Metals of unstated yield ---- */

static bool is_unstated(const struct problem *problem, size_t contact, int which)
{
    if (!problem_body(problem, contact, which)->yield_unstated ||
        problem->contact_model.choices[contact].own)
        return false;
    const struct material *material = problem_material(problem, contact, which);
    return isinf(material->yield) && plausible_metal(material->young, material->density);
}

/* Hertz's peak pressure at which the body yields: if it is ordinary where that is not stated. */
static double bears(const struct problem *problem, size_t contact, int which)
{
    struct material material = *problem_material(problem, contact, which);
    if (is_unstated(problem, contact, which))
        material.yield = MATERIAL_USUAL_YIELD_STRAIN * material.young;
    return closed_form_pressure(&material);
}

/* Restitution of the contact by itself, of `times` the energy at which the softer body yields. */
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

struct unstated_impact unstated_impact_of(const struct problem *problem,
                                          const struct impact_outcome *outcome, size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    double compression = problem->impulse_compression[contact];
    struct unstated_impact impact = {.force = outcome_peak_force(outcome, contact),
                                     .rebound = outcome_rebound(problem, outcome, contact),
                                     .range = outcome_range(problem, outcome)};
    if (contact_model_yielded(problem, outcome, contact))
        impact.depth = outcome->laws[contact].history.max_indentation /
                       problem->contact_model.choices[contact].yield;
    /* in a group the other contacts decide the order */
    double first = track->count > 0 && problem->contact_count == 1 ? track->list[0].impulse : 0.0;
    if (compression > 0.0)
        impact.later = (track->impulse - first) / compression;
    return impact;
}

double unstated_holds_above(const struct problem *problem, size_t contact, double force)
{
    if (!unstated_any(problem, contact))
        return 0.0;
    /* no more than the other body lets it become */
    double pressure = hertz_peak_pressure(&problem->hertz[contact], force);
    for (int which = 0; which < 2; which++)
        if (!is_unstated(problem, contact, which))
            pressure =
                smaller(pressure, CONTACT_FAMILY_HARD_ENOUGH * bears(problem, contact, which));
    return pressure / HERTZ_FIRST_YIELD;
}

double unstated_change(const struct problem *problem, size_t contact,
                       const struct unstated_impact *impact)
{
    if (!unstated_any(problem, contact))
        return 0.0;
    /* as the answer takes it, and with yields for all */
    double now = INFINITY, then = INFINITY;
    for (int which = 0; which < 2; which++) {
        double pressure = bears(problem, contact, which);
        then = smaller(then, pressure);
        if (!is_unstated(problem, contact, which))
            now = smaller(now, pressure);
    }
    /* energies over those of yield; that of Hertz's law goes by the fifth power of the pressure */
    double peak = hertz_peak_pressure(&problem->hertz[contact], impact->force);
    if (!(then < now) || !(peak > then || impact->depth > 1.0))
        return 0.0;
    bool flowed = impact->depth > 1.0;
    double before = flowed ? pow(impact->depth, 2.5) : 1.0;
    double after = flowed ? before * pow(now / then, 5.0) : pow(peak / then, 5.0);
    double back = given_back(problem, contact, then, after);
    if (flowed)
        back /= given_back(problem, contact, now, before);
    double share = larger(1.0 - back, 0.0);
    return smaller(share * impact->rebound +
                       smaller(share / OTHER_SUB_IMPACTS, 1.0) * impact->later,
                   impact->range);
}

double unstated_worst(const struct problem *problem, const struct impact_outcome *outcome)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        if (!unstated_any(problem, c))
            continue;
        struct unstated_impact impact = unstated_impact_of(problem, outcome, c);
        worst = larger(unstated_change(problem, c, &impact), worst);
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
            above = larger(unstated_holds_above(problem, c, outcome_peak_force(outcome, c)), above);
    if (!(above > 0.0))
        return;
    text_add(text, "; holds for metals that yield above ");
    add_stress(text, above);
    text_add(text, " MPa");
}

/* Names the metals of unstated yield, and the softest of them. Two bodies of one material are one
 * omission.
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
        lowest = smaller(lowest, pressure);
    }
    return softest;
}

/* Put together by pieces: it is said of many answers, and formats take longer than short solves. */
void unstated_find(const struct problem *problem, size_t contact,
                   const struct unstated_impact *impact, struct warnings *warnings)
{
    double change = unstated_change(problem, contact, impact);
    struct text text;
    if (!(change > problem->tolerance) || !warnings_begin(warnings, WARNING_UNSTATED, &text))
        return;
    double above = unstated_holds_above(problem, contact, impact->force);
    text_add(&text, "contacts[");
    text_add_count(&text, contact);
    text_add(&text, "]: no yield (or none) is stated of ");
    const struct material *softest = add_names(problem, contact, above, &text);
    text_add(&text, ": the answer holds for metals that yield above ");
    add_stress(&text, above);
    text_add(&text, " MPa");
    if (softest && above > MATERIAL_MOST_YIELD_STRAIN * softest->young) {
        text_add(&text, ", which hardly any does (young/100: ");
        add_stress(&text, MATERIAL_MOST_YIELD_STRAIN * softest->young);
        text_add(&text, " MPa)");
    }
    text_add(&text, "; at young/500 the restitution is off by up to ");
    text_add_number(&text, change, 2);
}

/* ---- Losses of the materials ---- */

/* Share of one of its bodies in the indentation of a contact. */
static double indentation_share(const struct problem *problem, size_t contact, int which)
{
    const struct material *const materials[2] = {problem_material(problem, contact, 0),
                                                 problem_material(problem, contact, 1)};
    return compliance_share(materials, which);
}

/* 1 - exp(-pi eta/2) of a rebound. */
static double lost_rebound(double rebound, double loss_factor)
{
    return loss_factor > 0.0 ? rebound * -expm1(-M_PI_2 * loss_factor) : 0.0;
}

/* Whether the contact's law has it. */
static bool has_loss(const struct problem *problem, size_t contact)
{
    return problem->contact_model.laws[contact].operations->remembers;
}

/* The work that a law of the catalogue does not give back is as well known as its force: of e^2 =
 * 1 - loss, deviation (1 - e^2)/(2 e). */
static double own_loss_deviation(const struct own_law *own, double rebound)
{
    double e = smaller(fabs(rebound), 1.0), lost = own->deviation * (1.0 - e * e);
    bool loses = own->hysteresis > 0.0 || own->dissipation > 0.0 || own->unloading.count > 0;
    return loses ? smaller(0.5 * lost / e, sqrt(lost)) : 0.0;
}

/* Of its loss factor. */
static double measured_loss_deviation(const struct problem *problem, size_t contact, double rebound)
{
    double loss_factor = problem->contact_model.choices[contact].loss->loss_factor;
    return LOSS_DEVIATION * M_PI_2 * loss_factor * rebound;
}

/* The bodies' parts of the contact's loss factor that standard solids of the stated frequencies
 * lack. */
static void lacking_loss(const struct problem *problem, size_t contact, double part[2])
{
    double frequency = problem->contact_model.choices[contact].loss->frequency;
    for (int which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, contact, which);
        part[which] = 0.0;
        if (body->loss_frequency > 0.0)
            part[which] = indentation_share(problem, contact, which) * body->loss_factor *
                          (1.0 - 1.0 / cosh(log(frequency / body->loss_frequency)));
    }
}

/* What they change: a force like half a sine loses 0.77 of what half a cycle does (the integral of
 * w |F|^2 over all frequencies), and nothing gives back more than it took; but in a group it may be
 * another contact that the bodies come back from. */
static double distance_deviation(const struct problem *problem, const double part[2],
                                 double rebound)
{
    double change = rebound * expm1(0.77 * M_PI_2 * (part[0] + part[1]));
    return problem->contact_count == 1 ? smaller(change, 1.0 - rebound) : change;
}

double loss_deviation(const struct problem *problem, size_t contact, double rebound)
{
    double part[2];
    const struct own_law *own = problem->contact_model.choices[contact].own;
    if (own)
        return own_loss_deviation(own, rebound);
    if (!has_loss(problem, contact))
        return 0.0;
    lacking_loss(problem, contact, part);
    return larger(measured_loss_deviation(problem, contact, rebound),
                  distance_deviation(problem, part, rebound));
}

/* The bodies' parts of the contact's loss factor, 0 where none is stated, or is in the answer;
 * their sum. */
static double stated_loss(const struct problem *problem, size_t contact, double part[2])
{
    for (int which = 0; which < 2; which++) {
        double loss_factor = problem_body(problem, contact, which)->loss_factor;
        bool stated = loss_factor > 0.0 && !has_loss(problem, contact) &&
                      !problem->contact_model.choices[contact].own;
        part[which] = stated ? indentation_share(problem, contact, which) * loss_factor : 0.0;
    }
    return part[0] + part[1];
}

/* A body's part that is certain where none is stated: of so soft a material. */
static double certain_loss(const struct problem *problem, size_t contact, int which)
{
    bool soft = isnan(problem_body(problem, contact, which)->loss_factor) &&
                problem_material(problem, contact, which)->young < MATERIAL_SOFT &&
                !problem->contact_model.choices[contact].own;
    return soft ? indentation_share(problem, contact, which) * MATERIAL_SOFT_LOSS : 0.0;
}

double loss_of_contact(const struct problem *problem, size_t contact, double rebound)
{
    double part[2], stated = stated_loss(problem, contact, part);
    return lost_rebound(
        rebound, stated + (certain_loss(problem, contact, 0) + certain_loss(problem, contact, 1)));
}

double loss_worst(const struct problem *problem, const struct impact_outcome *outcome)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        worst = larger(loss_of_contact(problem, c, outcome_rebound(problem, outcome, c)), worst);
    return worst;
}

/* What would have the loss in the answer, where it is CVODE that keeps it out. */
static const char *method_with_loss(const struct problem *problem)
{
    const struct solve_options *options = &problem->request->options;
    if (problem->friction_count == 0 || problem->contact_model.yielding ||
        options->contact_model != PERCUSS_CONTACT_AUTO || options->method != PERCUSS_METHOD_CVODE)
        return "";
    return "; method modal has it, or options.friction none";
}

/* Of both bodies together more than the tolerance: each that has half of it or more. */
static void find_stated_loss(const struct problem *problem, size_t contact, double rebound,
                             struct warnings *warnings)
{
    double part[2], both = stated_loss(problem, contact, part);
    double whole = lost_rebound(rebound, both);
    for (unsigned which = 0; which < 2 && whole > problem->tolerance; which++) {
        const struct body *body = problem_body(problem, contact, (int)which);
        if (part[which] >= 0.5 * both)
            warnings_add(
                warnings, WARNING_LOSS + which,
                "contacts[%zu]: what %s loses of itself in the contact (loss_factor %.3g) is not "
                "in the answer: the restitution is lower by about %.2g; the tolerance is %.2g%s",
                contact, body->id, body->loss_factor, whole, problem->tolerance,
                method_with_loss(problem));
    }
}

static void find_unstated_loss(const struct problem *problem, size_t contact, double rebound,
                               struct warnings *warnings)
{
    for (unsigned which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, contact, (int)which);
        double least = lost_rebound(rebound, certain_loss(problem, contact, (int)which));
        if (least > problem->tolerance)
            warnings_add(warnings, WARNING_LOSS + which,
                         "contacts[%zu]: materials as soft as that of %s (young %.4g MPa) lose "
                         "energy of themselves, of the restitution %.2g or more: no more than that "
                         "is in the error, as it has no loss_factor; state one (hard plastics 0.02 "
                         "to 0.1, rubber 0.05 to 1; 0: it loses nothing)",
                         contact, body->id,
                         1e-6 * problem_material(problem, contact, (int)which)->young, least);
    }
}

/* Of a loss in the answer that was measured so far off that this is the larger part of its error.
 */
static void find_distant_loss(const struct problem *problem, size_t contact, double rebound,
                              struct warnings *warnings)
{
    double part[2];
    lacking_loss(problem, contact, part);
    double change = distance_deviation(problem, part, rebound);
    if (!(change > problem->tolerance) ||
        !(change > measured_loss_deviation(problem, contact, rebound)))
        return;
    for (unsigned which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, contact, (int)which);
        if (part[which] >= 0.5 * (part[0] + part[1]))
            warnings_add(
                warnings, WARNING_LOSS + which,
                "contacts[%zu]: the loss_factor of %s (%.3g) was measured at %.4g Hz, and this "
                "contact has %.4g Hz: its loss may be another one, which may change the "
                "restitution by %.2g; state one measured nearer, or a relaxation",
                contact, body->id, body->loss_factor, body->loss_frequency,
                problem->contact_model.choices[contact].loss->frequency, change);
    }
}

void loss_find(const struct problem *problem, size_t contact, double rebound,
               struct warnings *warnings)
{
    if (has_loss(problem, contact))
        find_distant_loss(problem, contact, rebound, warnings);
    find_stated_loss(problem, contact, rebound, warnings);
    find_unstated_loss(problem, contact, rebound, warnings);
}
