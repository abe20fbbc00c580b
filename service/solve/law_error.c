/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/law_error.h"

#include <math.h>

#include "contact/family.h"
#include "contact/law_closed_form.h"
#include "contact/plastic.h"

/* What the family leaves between its places where nothing else limits it: against direct
 * computations on finer meshes (test_family). */
static const double TABLE = 0.004;
/* A table of just the two materials: the region against complete meshes, besides the error of its
 * own mesh, which it states of the force. */
static const double OWN_TABLE = 0.002;
/* For each decade beyond 30 times the indentation of yield: what springs back is little then. */
static const double DEEP = 0.006;
/* What the family adds where both bodies flow and only one of them is in it. */
static const double BOTH_YIELD = 0.004;
/* For each step outside the axes, and each decade beyond the computed depths. */
static const double OUTSIDE = 0.03;
static const double BEYOND = 0.02;

/* Restitution of the contact alone, from a depth: the root of the part of the work that comes back.
 */
static double restitution_from(const struct contact_law *law, double depth, double work)
{
    struct contact_law used = *law;
    used.history = (struct contact_history){0};
    contact_law_yield(&used, depth);
    return sqrt(used.operations->stored(&used, contact_law_limit(&used)) / work);
}

double law_error_depth(const struct contact_law *law, double work)
{
    const struct plastic_curve *curve = law->operations->curve;
    double d = curve->yield(law);
    for (int i = 0; i < 60; i++) {
        double slope;
        double here = curve->work(law, d);
        double change = log(work / here) * here / (curve->force(law, d, &slope) * d);
        d *= exp(fmax(-3.0, fmin(change, 3.0)));
        if (!(fabs(change) > 1e-9))
            break;
    }
    return d;
}

/* How much less, or more, of the same work the contact gives back by the family. */
static double against_family(const struct contact_law *law, const struct contact_law *family,
                             double depth)
{
    double work = law->operations->curve->work(law, depth);
    double other = law_error_depth(family, work);
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
    double way = log(fmax(depth, 1.0));
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

/* Of the compliance of a contact, what one of its bodies has. */
static double share_of(const struct material *const materials[2], int side)
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
            pressure = fmax(pressure, lost_pressure(m[i], w));
        stored += lost_storage(m[i], share_of(m, i), w);
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
    double error = beyond > 1.0 ? BEYOND * log10(beyond) : 0.0;
    error += DEEP * log10(fmax(depth / (30.0 * choice->yield), 1.0));
    if (!choice->family)
        return error + OWN_TABLE + contact_curves_error(choice->plastic.table);
    return error + TABLE + OUTSIDE * choice->outside + (choice->both ? BOTH_YIELD : 0.0);
}

void law_error_parts(const struct problem *problem, size_t contact,
                     const struct contact_history *history, double parts[2])
{
    const struct contact_choice *choice = &problem->contact_model.choices[contact];
    /* size and shape */
    const struct material *m[2] = {problem_material(problem, contact, 0),
                                   problem_material(problem, contact, 1)};
    const struct material *soft = m[choice->side];
    double hardening = soft->tangent / soft->young;
    parts[0] = by_size(history->contact_radius / closed_form_radius(&problem->hertz[contact])) +
               by_roundness(problem, contact, history->contact_radius) +
               by_ellipse(&problem->hertz[contact]);
    /* the law itself, by what it can be held against */
    if (choice->tabulated)
        parts[1] = by_table(choice, history->max_indentation);
    else if (!choice->compared.operations)
        parts[1] = TABLE + by_closed_form(history->max_indentation / choice->yield, hardening,
                                          share_of(m, choice->side));
    else
        parts[1] =
            TABLE + against_family(&choice->plastic, &choice->compared, history->max_indentation);
}

/* Of a contact that yielded; nothing of one that did not. */
static void find_parts(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t contact, double parts[2])
{
    parts[0] = parts[1] = 0.0;
    if (contact_model_yielded(problem, outcome, contact))
        law_error_parts(problem, contact, &outcome->laws[contact].history, parts);
}

double law_error(const struct problem *problem, const struct impact_outcome *outcome,
                 size_t contact)
{
    double parts[2];
    find_parts(problem, outcome, contact, parts);
    return parts[0] + parts[1];
}

const char *law_error_reason(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact)
{
    const struct contact_choice *choice = &problem->contact_model.choices[contact];
    double parts[2];
    find_parts(problem, outcome, contact, parts);
    if (parts[0] > parts[1])
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
    struct contact_law harder = contact_law_rescaled(law, 1.0, 1.0 + step);
    double work = law->operations->curve->work(law, depth);
    double e = restitution_from(law, depth, work);
    double more = restitution_from(&harder, law_error_depth(&harder, work), work);
    double slope = log(more / e) / log1p(step);
    return slope > 0.0 ? fmin(exp(share / slope), most) : most;
}

double law_error_worst(const struct problem *problem, const struct impact_outcome *outcome)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        worst = fmax(worst, law_error(problem, outcome, c));
    return worst;
}
