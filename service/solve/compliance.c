/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/compliance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "model/vector.h"
#include "solve/outcome.h"
#include "solve/radiation.h"

/* A hit counts as central up to this share of the radius: the correction is of second order in it.
 */
static const double CENTRAL = 0.1;
/* Fewer modes of a mesh are not tried: they leave its flexibility to one spring. */
enum { LEAST_MODES = 6 };
/* And as on an end face from this part of the length on: the rest is its rounding. */
static const double END = 0.45;

/* Contact radius (m) of a collision of the rigid masses at the fastest approach: the correction
 * depends on its logarithm at most. */
static double patch_radius(const struct problem *problem, size_t c)
{
    const struct hertz_contact *hertz = &problem->hertz[c];
    size_t n = problem->contact_count;
    double speed = problem_approach(problem);
    double energy = 0.5 * speed * speed / problem->w[c * (n + 1)];
    double force = hertz->stiffness * pow(energy / (HERTZ_WORK * hertz->stiffness), 0.6);
    double axes[2];
    hertz_ellipse(hertz, force, axes);
    return sqrt(axes[0] * axes[1]);
}

static bool is_central(const struct body *body, const double point[3])
{
    double off = hypot(point[1], point[2]);
    double length = fabs(point[0]);
    return off <= CENTRAL * body->radius && length > END * body->length;
}

/* A mesh's or a box's static compliance is the real body's beyond the half-space. */
static bool is_matched_by_nature(const struct body *body)
{
    return body_is_solid(body);
}

/* So is that of a beam's side: its theory lacks the place's own. */
static bool is_side_of_beam(const struct contact_side *side, const struct body *body)
{
    return side->site.face == SITE_BEAM_SIDE && body_bends(body) &&
           body->theory == THEORY_TIMOSHENKO;
}

static double side_of_beam(const struct problem *problem, const struct contact_side *side)
{
    const struct site *site = &side->site;
    return problem->compliance.bare
               ? 0.0
               : beam_side_compliance(problem->bodies[side->body], site->point, site->outward);
}

/* The correction of one side of a contact, m/N. NAN: none is known. False: out of memory. */
static bool side_compliance(struct problem *problem, size_t c, int which, double *compliance)
{
    const struct contact_side *side = &problem->sides[c][which];
    const struct body *body = problem->bodies[side->body];
    enum solid_form form = body_solid(body).form;
    /* the family holds it, for one contact radius */
    if (is_matched_by_nature(body)) {
        const struct face_spot *spot = &side->site.spot;
        const struct mesh_load *load = &side->load.family[0].mesh;
        *compliance = 0.0;
        if (load->slope != 0.0) {
            problem->compliance.by_speed = true;
            *compliance = load->slope * log(load->cut / patch_radius(problem, c));
        }
        if (body->mesh && spot->slope != 0.0 && body->mesh->cut > 0.0) {
            problem->compliance.by_speed = true;
            *compliance =
                spot->slope * log(body->scale * body->mesh->cut / patch_radius(problem, c));
        }
        return true;
    }
    if (is_side_of_beam(side, body)) {
        *compliance = side_of_beam(problem, side);
        return true;
    }
    *compliance = NAN;
    if (form == SOLID_CYLINDER && !is_central(body, side->site.point))
        return true;
    double patch = 0.0;
    if (form == SOLID_BALL) {
        patch = patch_radius(problem, c);
        problem->compliance.by_speed = true;
    }
    return prepared_matched_get(problem->cache, body, patch, compliance);
}

/* Also without the corrections of bodies a beam keeps its own. */
static void use_half_space(struct problem *problem, const char *why)
{
    struct compliance *compliance = &problem->compliance;
    compliance->used = PERCUSS_COMPLIANCE_HALF_SPACE;
    compliance->by_speed = false;
    memset(compliance->series, 0, problem->contact_count * sizeof *compliance->series);
    memset(compliance->sides, 0, problem->contact_count * sizeof *compliance->sides);
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            if (is_side_of_beam(side, problem->bodies[side->body]))
                compliance->sides[c][which] = side_of_beam(problem, side);
            compliance->series[c] += compliance->sides[c][which];
        }
    compliance->reason[0] = '\0';
    if (*why) /* usually nothing is to be said */
        snprintf(compliance->reason, sizeof compliance->reason, "%s", why);
}

static bool any_flexible(const struct problem *problem, size_t c)
{
    for (int which = 0; which < 2; which++)
        if (body_is_flexible(problem->bodies[problem->sides[c][which].body]))
            return true;
    return false;
}

static bool any_mesh(const struct problem *problem)
{
    for (size_t i = 0; i < 2 * problem->contact_count; i++)
        if (is_matched_by_nature(problem_body(problem, i / 2, i % 2)))
            return true;
    return false;
}

static void find_matched(struct problem *problem, bool asked)
{
    struct compliance *compliance = &problem->compliance;
    compliance->used = PERCUSS_COMPLIANCE_MATCHED;
    /* of every contact, or of none */
    for (size_t c = 0; c < problem->contact_count; c++) {
        if (!asked && !any_flexible(problem, c)) {
            use_half_space(problem, "");
            return;
        }
        for (int which = 0; which < 2; which++) {
            double *part = &compliance->sides[c][which];
            if (!side_compliance(problem, c, which, part))
                problem->arena->lacks = true;
            if (!isfinite(*part)) {
                char why[sizeof compliance->reason];
                const struct contact_side *side = &problem->sides[c][which];
                snprintf(why, sizeof why, "no matched compliance is known for %s there",
                         problem->bodies[side->body]->id);
                use_half_space(problem, why);
                return;
            }
            compliance->series[c] += *part;
        }
    }
}

enum percuss_status compliance_choose(struct problem *problem, enum percuss_compliance otherwise,
                                      struct fault *fault)
{
    struct compliance *compliance = &problem->compliance;
    size_t n = problem->contact_count;
    *compliance =
        (struct compliance){.series = arena_take(problem->arena, n, sizeof *compliance->series),
                            .sides = arena_take(problem->arena, n, sizeof *compliance->sides)};
    if (!compliance->series || !compliance->sides)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_compliance asked = problem->request->options.compliance;
    enum percuss_compliance wanted = asked;
    if (asked == PERCUSS_COMPLIANCE_DEFAULT)
        wanted = any_mesh(problem) ? PERCUSS_COMPLIANCE_MATCHED : otherwise;
    if (wanted == PERCUSS_COMPLIANCE_HALF_SPACE)
        use_half_space(problem, "");
    else
        find_matched(problem, asked == PERCUSS_COMPLIANCE_MATCHED);
    return PERCUSS_OK;
}

/* Hertz's slope at the largest force of a contact, N/m: 3/2 k^(2/3) F^(1/3), or that of unloading
 * from a dent. */
static double largest_stiffness(const struct problem *problem, const struct impact_outcome *outcome,
                                size_t c)
{
    double k = problem->hertz[c].stiffness;
    double force = outcome_peak_force(outcome, c);
    return fmax(1.5 * cbrt(k * k * force), contact_law_unloading(&outcome->laws[c]));
}

/* Most modes of a mesh that take part. */
static size_t mesh_modes(const struct problem *problem, const struct scene *scene)
{
    size_t most = 0;
    for (size_t g = 0; g < scene->groups; g++)
        if (body_is_solid(problem->bodies[scene->group[g].body]) && scene->group[g].count > most)
            most = scene->group[g].count;
    size_t allowed = problem->compliance.most;
    return allowed > 0 && allowed < most ? allowed : most;
}

static bool any_side(const struct problem *problem)
{
    for (size_t i = 0; i < 2 * problem->contact_count; i++)
        if (is_side_of_beam(&problem->sides[i / 2][i % 2], problem_body(problem, i / 2, i % 2)))
            return !problem->compliance.bare;
    return false;
}

bool compliance_revise(struct problem *problem, const struct scene *scene,
                       const struct impact_outcome *outcome)
{
    /* nothing else is ever taken back */
    bool radiates = radiation_is_in(problem, scene);
    bool matched = problem->compliance.used == PERCUSS_COMPLIANCE_MATCHED;
    if (!matched && !radiates && !any_side(problem) && mesh_modes(problem, scene) <= LEAST_MODES)
        return false;
    /* waves that contacts share may take all of the effort */
    if (outcome->end_reason == PERCUSS_END_LIMIT && radiation_is_shared(problem, scene)) {
        problem->compliance.still = true;
        return true;
    }
    /* too stiff a contact: without waves, then without matched compliance, then without a beam's */
    for (size_t c = 0; c < scene->contacts; c++) {
        if (!outcome->too_stiff && contact_bears(scene, c, largest_stiffness(problem, outcome, c)))
            continue;
        if (radiates)
            problem->compliance.still = true;
        else if (mesh_modes(problem, scene) > LEAST_MODES)
            problem->compliance.most = mesh_modes(problem, scene) * 2 / 3;
        else {
            problem->compliance.bare = !matched;
            use_half_space(problem,
                           "the matched compliance is too negative for so stiff a contact");
        }
        return true;
    }
    return false;
}
