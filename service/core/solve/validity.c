/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/validity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/extremes.h"
#include "model/beam.h"
#include "model/rigid.h"
#include "model/vector.h"
#include "solve/askew.h"
#include "solve/contact_model.h"
#include "solve/error/deviation.h"
#include "solve/error/law.h"
#include "solve/oblique.h"
#include "solve/outcome.h"

/* Contact or dent against the smallest radius: surfaces are no longer parabolas there. */
static const double LARGEST_CONTACT = 0.3;
/* Speed along the surface against that of approach: some 3 degrees. Slower sliding can
 * take 1.4 % of the normal impulse whatever the coefficient: a sphere has stopped sliding after
 * sliding / (3.5 (1 + e) approach) of it. */
static const double SLIDING = 0.05;
/* Share of the energy that the vibration of a sphere takes, times the wave speed over that of the
 * approach: about v/(50 c) (Rayleigh; Goldsmith). */
static const double SPHERE_VIBRATION = 0.02;
/* Speed against that of waves: strains are a hundredth then, and no longer small. */
static const double FAST = 0.01;
/* A client's W that differs by more is of other bodies. */
static const double OTHER_BODIES = 0.01;
/* Error of a contact law, of the restitution, that is worth a warning. */
static const double WRONG_LAW = 0.05;
/* Of compact bodies that meet: the speed that tables are deep enough for by default. */
static const double TABLE_SPEED = 1.0;
/* A coefficient of friction as of dry metals, to say how much it may be about. */
static const double FRICTION = 0.3;

/* Of a fitted normal, rad: 2 degrees, as for a declared one. */
static const double DOUBT = 2.0 * M_PI / 180.0;

static double wave_speed(const struct body *body)
{
    return sqrt(body->material.young / body->material.density);
}

double validity_wave_loss(const struct problem *problem)
{
    double worst = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double speed = fabs(problem->gap_rate[c]);
        double energy_share = 0.0;
        for (int which = 0; which < 2; which++) {
            const struct body *body = problem_body(problem, c, which);
            if (isfinite(body->mass) && !body_is_flexible(body))
                energy_share += SPHERE_VIBRATION * (speed / wave_speed(body));
        }
        /* e^2 = 1 - share */
        worst = larger(0.5 * energy_share, worst);
    }
    return worst;
}

static void find_yield(const struct problem *problem, size_t c, double pressure,
                       struct warnings *warnings)
{
    for (unsigned which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, c, which);
        double yield = problem_material(problem, c, (int)which)->yield;
        if (pressure > HERTZ_FIRST_YIELD * yield)
            warnings_add(warnings, WARNING_YIELD + which,
                         "contacts[%zu]: the elastic peak pressure of %.3g MPa exceeds 1.6 times "
                         "the yield stress of %s (%.3g MPa): Hertz's law leaves no dent, the true "
                         "restitution is lower (contact_model auto or closed-form)",
                         c, pressure / 1e6, body->id, yield / 1e6);
    }
}

/* Contacts and dents as large as the surface that they are on. */
static void find_size(const struct problem *problem, const struct impact_outcome *outcome, size_t c,
                      double half_axis, struct warnings *warnings)
{
    double dent =
        contact_model_yielded(problem, outcome, c) ? outcome->laws[c].history.contact_radius : 0.0;
    for (unsigned which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, c, which);
        double size = body_smallest_radius(body);
        if (half_axis > LARGEST_CONTACT * size)
            warnings_add(warnings, WARNING_PATCH + which,
                         "contacts[%zu]: the contact's half-axis of %.3g m is more than 30 %% of "
                         "the smallest radius of %s (%.3g m): Hertz's law ends there",
                         c, half_axis, body->id, size);
        if (dent > LARGEST_CONTACT * size)
            warnings_add(warnings, WARNING_DENT + which,
                         "contacts[%zu]: the dent's radius of %.3g m is more than 30 %% of the "
                         "smallest radius of %s (%.3g m): the contact laws end there",
                         c, dent, body->id, size);
    }
}

/* On a mesh: a contact wider than half its distance from an edge, or nearer to it than the
 * element there is long (service/tools/reduce), and a site with a surface that is declared
 * otherwise than it is or is not well known. */
static void find_mesh_place(const struct problem *problem, size_t c, unsigned which,
                            double half_axis, struct warnings *warnings)
{
    const struct face_spot *spot = &problem->sides[c][which].site.spot;
    const struct body *body = problem_body(problem, c, which);
    /* an edge that is near: beside the contact's width, else beside the elements */
    if (half_axis > 0.5 * spot->edge)
        warnings_add(warnings, WARNING_EDGE + which,
                     "contacts[%zu]: %.3g m from an edge of %s, with a half-axis of %.3g m: the "
                     "contact law assumes material on all sides",
                     c, spot->edge, body->id, half_axis);
    else if (spot->element > spot->edge && body_is_flexible(body))
        warnings_add(
            warnings, WARNING_EDGE + which,
            "contacts[%zu]: %.3g m from an edge of %s, whose elements there are %.3g m long: "
            "its flexibility there is uncertain",
            c, spot->edge, body->id, spot->element);
    /* the site's own remark */
    if (spot->remark)
        warnings_add(warnings, WARNING_EDGE + which, "contacts[%zu]: on %s: %s", c, body->id,
                     spot->remark);
    /* a normal that the mesh leaves open */
    if (spot->doubt > DOUBT)
        warnings_add(
            warnings, WARNING_EDGE + which,
            "contacts[%zu]: the surface's normal on %s is uncertain by %.2g degrees there: "
            "a declared site or a finer mesh says more",
            c, body->id, spot->doubt * 180.0 / M_PI);
}

/* A quotation mark about an id that a shell would take apart. */
static const char *mark(const char *id)
{
    return id[strspn(id, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-")] ? "'"
                                                                                               : "";
}

/* The command that makes a table of two bodies, as deep as this impact goes, and how the table then
 * comes into use: to be pasted, so all of it or none. */
static void tell_remedy(const struct problem *problem, size_t c, char *text, size_t size)
{
    const struct contact_table_remedy *remedy = problem->contact_model.remedy;
    const struct contact_table_remedy unknown = {
        "percuss-tables --catalogue FILE --folder DIR",
        "which the next start uses with DIR among the `tables` of its settings"};
    const char *a = problem_body(problem, c, 0)->id, *b = problem_body(problem, c, 1)->id;
    double speed = fabs(problem->gap_rate[c]);
    char deep[40] = "";
    if (speed > TABLE_SPEED)
        snprintf(deep, sizeof deep, " --speed %.0f", ceil(speed));
    /* one that does not fit is told in general */
    int length = -1;
    if (remedy)
        length = snprintf(text, size, ": %s%s --a %s%s%s --b %s%s%s makes one, %s", remedy->command,
                          deep, mark(a), a, mark(a), mark(b), b, mark(b), remedy->then);
    if (length < 0 || (size_t)length >= size)
        snprintf(text, size, ": %s%s --a %s --b %s makes one, %s", unknown.command, deep, a, b,
                 unknown.then);
}

/* A share of a contact's restitution as a number too, as model.omitted_error has it. */
static struct share {
    char text[64];
} share_of(const struct problem *problem, const struct impact_outcome *outcome, size_t c,
           double share)
{
    struct share told;
    double compression = problem->impulse_compression[c];
    int used =
        snprintf(told.text, sizeof told.text, share < 0.1 ? "%.2g %%" : "%.0f %%", 100.0 * share);
    if (compression > 0.0)
        snprintf(told.text + used, sizeof told.text - (size_t)used, " (%.2g)",
                 share * fabs(outcome->tracks[c].impulse / compression - 1.0));
    return told;
}

/* A body that yields by a law which is not of its own material, and how that can be mended. Bodies
 * that only this request has get no table. False: nothing to say. */
static bool find_table(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t c, double error, struct warnings *warnings)
{
    const struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct body *a = problem_body(problem, c, 0);
    const struct body *b = problem_body(problem, c, 1);
    enum percuss_contact_model asked = problem->request->options.contact_model;
    bool may = contact_law_asked(asked)->tables == CONTACT_TABLES_IF_ANY;
    /* the family's is as good unless these metals are none of it */
    bool good = choice->tabulated && !(choice->outside > 0.0 || choice->both);
    if (!may || good || !contact_model_yielded(problem, outcome, c))
        return false;
    /* the command that makes one */
    char how[WARNING_SIZE - 400] = "";
    bool round = body_has_sphere(a) || body_has_sphere(b);
    if (round && problem->hertz[c].axis_ratio >= HERTZ_CIRCULAR_RATIO && !a->varied && !b->varied)
        tell_remedy(problem, c, how, sizeof how);
    warnings_add(warnings, WARNING_LAW,
                 "contacts[%zu]: %s yields and there is no table of %s on %s: %s is off by about "
                 "%s of the restitution, a part of the models' own error%s",
                 c, (choice->side == 0 ? a : b)->id, a->material.name, b->material.name,
                 choice->family ? "the family of tables" : "the closed form",
                 share_of(problem, outcome, c, error).text, how);
    return true;
}

static void find_place(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t c, double half_axis, struct warnings *warnings)
{
    /* near an edge */
    for (unsigned which = 0; which < 2; which++)
        if (problem_body(problem, c, which)->mesh)
            find_mesh_place(problem, c, which, half_axis, warnings);
        else if (problem->sides[c][which].site.at_edge)
            warnings_add(warnings, WARNING_EDGE + which,
                         "contacts[%zu]: within 10 %% of the radius of an edge of %s: the contact "
                         "law assumes material on all sides",
                         c, problem_body(problem, c, which)->id);
    /* without a table of its own, and where the law is far off */
    double error = law_error(problem, outcome, c);
    if (!find_table(problem, outcome, c, error, warnings) && error > WRONG_LAW)
        warnings_add(warnings, WARNING_LAW,
                     "contacts[%zu]: the contact law itself is estimated to be off by %.2g of the "
                     "restitution: %s",
                     c, error, law_error_reason(problem, outcome, c));
    /* deeper than its table */
    double beyond = contact_model_beyond_table(outcome, c);
    if (beyond > 0.0)
        warnings_add(warnings, WARNING_TABLE_END,
                     "contacts[%zu]: the table ends before the largest indentation, by %.2g of "
                     "its range: it goes on as a fully plastic contact",
                     c, beyond);
}

void validity_find_speed(const struct problem *problem, struct warnings *warnings)
{
    for (size_t c = 0; c < problem->contact_count; c++)
        for (unsigned which = 0; which < 2; which++) {
            const struct body *body = problem_body(problem, c, which);
            double speed = fabs(problem->gap_rate[c]);
            if (speed > FAST * wave_speed(body))
                warnings_add(warnings, WARNING_SPEED + which,
                             "contacts[%zu]: the approach at %.3g m/s is more than 1 %% of the "
                             "wave speed in %s (%.4g m/s): small strains end there",
                             c, speed, body->id, wave_speed(body));
        }
}

void validity_find_waves(const struct problem *problem, double radiated, struct warnings *warnings)
{
    double unmodelled = radiated + validity_wave_loss(problem);
    if (unmodelled > problem->tolerance)
        warnings_add(warnings, WARNING_WAVES,
                     "model.omitted_error: waves that the models leave out of compact bodies and "
                     "of half-spaces change the restitution by about %.2g: more than the tolerance "
                     "of %.2g",
                     unmodelled, problem->tolerance);
}

/* Speed along `direction` (unit, world) of the bodies' points against each other after a unit of
 * impulse along it, 1/kg, by the bodies' own masses. */
static double inverse_mass_along(const struct problem *problem, size_t c, const double direction[3])
{
    double sum = 0.0;
    for (unsigned which = 0; which < 2; which++) {
        const struct contact_side *side = &problem->sides[c][which];
        double local[3];
        rotate_back3(problem->poses[side->body].rotation, direction, local);
        sum += rigid_inverse_mass(problem->bodies[side->body], side->site.point, local,
                                  side->site.point, local);
    }
    return sum;
}

/* Coulomb's friction transmits at most its coefficient times the normal impulse, and no more than
 * stops the sliding. An articulated body's mass along the surface is not known. */
static void find_sliding(const struct problem *problem, const struct impact_outcome *outcome,
                         size_t c, double approach, struct warnings *warnings)
{
    /* only where it slides fast */
    double impulse = FRICTION * outcome->tracks[c].impulse;
    double speed = norm3(problem->sliding[c]);
    char change[64] = "";
    if (oblique_of(problem, c) || !(impulse > 0.0 && speed > SLIDING * approach))
        return;
    /* no more than stops it, as far as the mass along the surface is known */
    if (!problem->from_client) {
        double direction[3];
        scale3(1.0 / speed, problem->sliding[c], direction);
        double w = inverse_mass_along(problem, c, direction);
        if (w * impulse > speed)
            impulse = speed / w;
        snprintf(change, sizeof change, " and change that speed by up to %.3g m/s", w * impulse);
    }
    warnings_add(
        warnings, WARNING_SLIDING,
        "contacts[%zu]: the bodies slide there at %.3g m/s, %.3g times the approach: "
        "without a coefficient of friction the answer has none; one of %.1f could transmit "
        "up to %.3g N s along the surface%s",
        c, speed, speed / approach, FRICTION, impulse, change);
}

/* Turn of the surfaces during a contact, rad, and slip over the contact's radius, from which on the
 * tangents and the place of a contact with friction move with it: they are held. */
static const double TURN = 0.02;
static const double WAY = 0.3;

/* The longest sub-impact's turn, by the spins before, and its slip. */
static void find_turn(const struct problem *problem, const struct impact_outcome *outcome, size_t c,
                      double radius, struct warnings *warnings)
{
    double duration = model_impact_of(problem, outcome, c).duration;
    double way = norm3(problem->sliding[c]) * duration;
    double turn = 0.0;
    for (int which = 0; which < 2; which++) {
        const double *spin =
            problem->request->bodies[problem->sides[c][which].body].angular_velocity;
        turn = larger(turn, norm3(spin) * duration);
    }
    if (!oblique_of(problem, c) || !(turn > TURN || way > WAY * radius))
        return;
    struct text text;
    if (!warnings_begin(warnings, WARNING_TURN, &text))
        return;
    text_format(&text, "contacts[%zu]: its bodies ", c);
    if (turn > 0.0)
        text_format(&text, "turn by up to %.2g rad%s", turn, way > 0.0 ? " and " : "");
    if (way > 0.0)
        text_format(&text, "slide by up to %.2g m", way);
    text_format(&text,
                " during a contact (its radius: %.2g m): the answer holds its place and its "
                "tangents still",
                radius);
}

/* A mesh whose flexibility along the surface is taken for that across it (mesh_family_along). */
static void find_along(const struct problem *problem, size_t c, struct warnings *warnings)
{
    const struct contact_friction *friction = oblique_of(problem, c);
    for (unsigned which = 0; friction && which < 2; which++) {
        const struct body *body = problem_body(problem, c, which);
        const struct mesh_load *along = &friction->sides[0][which].load.family[0].mesh;
        if (!body->mesh || !body_is_flexible(body) || along->all_ways)
            continue;
        if (!body->mesh->all_ways)
            warnings_add(warnings, WARNING_ALONG + which,
                         "contacts[%zu].friction: the file of %s does not say how it gives way "
                         "along its surface: taken as across it, to 30 %%; percuss-reduce of this "
                         "release writes that: reduce its mesh again",
                         c, body->id);
        else
            warnings_add(warnings, WARNING_ALONG + which,
                         "contacts[%zu].friction: the mesh of %s is too coarse there to say how it "
                         "gives way along its surface: taken as across it, to 30 %%; give "
                         "percuss-reduce --site there, or smaller elements",
                         c, body->id);
    }
}

/* Painleve: friction that presses the bodies together more than the rigid masses part them. */
static void find_jam(const struct problem *problem, size_t c, struct warnings *warnings)
{
    size_t rows = problem_rows(problem);
    const double *w = problem->row_w + c * rows;
    for (size_t i = 0; i < problem->friction_count; i++) {
        const struct contact_friction *friction = &problem->friction[i];
        size_t row = problem->contact_count + 2 * i;
        double across = friction->coefficient * hypot(w[row], w[row + 1]);
        if (friction->contact != c || !(across > w[c]))
            continue;
        warnings_add(warnings, WARNING_JAM,
                     "contacts[%zu].friction: %g: sliding friction may press the bodies together "
                     "by itself there, from %.3g on: the restitution by impulses says little; the "
                     "velocities hold",
                     c, friction->coefficient, friction->coefficient * w[c] / across);
    }
}

/* Bodies taken as rigid that would not be; of balls see validity_wave_loss. */
static void find_rigid(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t c, struct warnings *warnings)
{
    const struct model_impact blow = model_impact_of(problem, outcome, c);
    for (unsigned which = 0; which < 2; which++) {
        double rings = deviation_of_rigid(problem, c, (int)which, &blow);
        const struct body *body = problem_body(problem, c, (int)which);
        bool ball = body_solid(body).form == SOLID_BALL;
        if (rings > problem->tolerance && !ball)
            warnings_add(warnings, WARNING_RIGID + which,
                         "contacts[%zu]: %s is taken as rigid: its vibration would take up to "
                         "about %.2g of the restitution; the tolerance is %.2g: %s",
                         c, body->id, rings, problem->tolerance,
                         body->rigid ? "without rigid: true the answer has it"
                                     : "a beam, or a mesh, has its vibration");
    }
}

/* Plates that are declared as beams. */
static void find_breadth(const struct problem *problem, size_t c, struct warnings *warnings)
{
    for (unsigned which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, c, (int)which);
        const struct site *site = &problem->sides[c][which].site;
        if (!body_bends(body) || site->face != SITE_BEAM_SIDE || !(body->width > 0.0))
            continue;
        bool on_top = fabs(site->outward[2]) > fabs(site->outward[1]);
        double broad = on_top ? body->width / body->height : body->height / body->width;
        if (broad > BEAM_BROADEST)
            warnings_add(warnings, WARNING_BREADTH + which,
                         "contacts[%zu]: the section of %s is %.3g times as broad as deep, and "
                         "bends across its breadth as well, which a theory of beams leaves out: "
                         "without theory, shear_factor and pinned ends it is computed as a block",
                         c, body->id, broad);
    }
}

/* Another contact on a mesh whose flexibility is solved for at single places: nothing is known
 * between them but the modes. */
static void find_between(const struct problem *problem, size_t c, struct warnings *warnings)
{
    for (unsigned which = 0; which < 2; which++) {
        size_t index = problem->sides[c][which].body;
        const struct body *body = problem->bodies[index];
        bool alone = true;
        for (size_t other = 0; other < c; other++)
            alone = alone && problem->sides[other][0].body != index &&
                    problem->sides[other][1].body != index;
        if (!alone && body->mesh && mesh_body_is_later(body->mesh) && body_is_flexible(body))
            warnings_add(warnings, WARNING_BETWEEN,
                         "contacts[%zu]: of what contacts on %s do to each other its modes alone "
                         "are known: reduce its mesh with flexibility ahead for more",
                         c, body->id);
    }
}

/* Of a law of the catalogue, whose shape and material are not the bodies'. */
static void find_end_of_points(const struct problem *problem, const struct impact_outcome *outcome,
                               size_t c, struct warnings *warnings)
{
    const struct own_law *own = problem->contact_model.choices[c].own;
    double beyond = contact_model_beyond_table(outcome, c);
    if (beyond > 0.0)
        warnings_add(warnings, WARNING_TABLE_END,
                     "contacts[%zu]: the points of the law %s end before the largest indentation, "
                     "by %.2g of their range: the force goes on by their last slope",
                     c, own->name, beyond);
}

static void find_contact(const struct problem *problem, const struct impact_outcome *outcome,
                         size_t c, double approach, struct warnings *warnings)
{
    const struct hertz_contact *hertz = &problem->hertz[c];
    double force = outcome_peak_force(outcome, c);
    double axes[2];
    hertz_ellipse(hertz, force, axes);
    if (problem->contact_model.choices[c].own) {
        find_end_of_points(problem, outcome, c, warnings);
    } else {
        if (!problem->contact_model.laws[c].operations->curve)
            find_yield(problem, c, hertz_peak_pressure(hertz, force), warnings);
        find_size(problem, outcome, c, axes[0], warnings);
        find_place(problem, outcome, c, axes[0], warnings);
    }
    find_sliding(problem, outcome, c, approach, warnings);
    if (problem->friction_count) {
        find_turn(problem, outcome, c, axes[0], warnings);
        find_jam(problem, c, warnings);
        find_along(problem, c, warnings);
    }
    find_rigid(problem, outcome, c, warnings);
    find_breadth(problem, c, warnings);
    find_between(problem, c, warnings);
    if (!problem->contact_model.choices[c].own)
        loss_find(problem, c, outcome_rebound(problem, outcome, c), warnings);
    askew_find(problem, c, model_impact_of(problem, outcome, c).duration, warnings);
    if (unstated_any(problem, c)) {
        struct unstated_impact blow = unstated_impact_of(problem, outcome, c);
        unstated_find(problem, c, &blow, warnings);
    }
}

static void find_delassus(const struct problem *problem, struct warnings *warnings)
{
    size_t rows = problem_rows(problem);
    double worst = 0.0;
    for (size_t i = 0; i < rows * rows; i++) {
        size_t a = i / rows, b = i % rows;
        double scale = sqrt(problem_row_scale(problem, a) * problem_row_scale(problem, b));
        double differs = problem->row_w[i] - problem_inverse_mass(problem, a, b);
        worst = larger(fabs(differs) / scale, worst);
    }
    if (worst > OTHER_BODIES)
        warnings_add(warnings, WARNING_DELASSUS,
                     "delassus: differs from that of the catalogue's bodies by up to %.3g %%: the "
                     "client's is used",
                     100.0 * worst);
}

void validity_find(const struct problem *problem, const struct impact_outcome *outcome,
                   struct warnings *warnings)
{
    /* a contact that was cut off is not listed */
    bool touches =
        outcome->end_reason == PERCUSS_END_LIMIT || outcome->end_reason == PERCUSS_END_IN_CONTACT;
    /* the contacts that close, and whether they touched */
    double approach = problem_approach(problem);
    warnings->count = 0;
    warnings->kinds = 0;
    for (size_t c = 0; c < problem->contact_count; c++)
        touches = touches || outcome->tracks[c].count > 0;
    if (!touches && outcome->end_reason != PERCUSS_END_LIMIT)
        warnings_add(warnings, WARNING_NO_TOUCH,
                     "contacts: the bodies do not touch: gap and acceleration keep them apart");
    /* contact by contact */
    for (size_t c = 0; c < problem->contact_count; c++)
        find_contact(problem, outcome, c, approach, warnings);
    validity_find_speed(problem, warnings);
    /* and of all */
    if (problem->from_client)
        find_delassus(problem, warnings);
    if (problem->request->options.compliance == PERCUSS_COMPLIANCE_MATCHED &&
        problem->compliance.used != PERCUSS_COMPLIANCE_MATCHED)
        warnings_add(warnings, WARNING_COMPLIANCE,
                     "options.compliance: matched: %s: half-space is used",
                     problem->compliance.reason);
}
