/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/deviation.h"

#include <math.h>

#include "base/extremes.h"
#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "model/beam.h"
#include "model/half_space.h"
#include "model/plate.h"
#include "solve/contact_model.h"
#include "solve/error/calibration.h"
#include "solve/error/law.h"
#include "solve/outcome.h"

static double wave_speed(const struct body *body)
{
    return sqrt(body->material.young / body->material.density);
}

/* Longest of the body's dimensions. */
static double extent(const struct body *body)
{
    double longest = larger(body->length, 2.0 * body->radius);
    for (int i = 0; i < 3; i++)
        longest = larger(longest, body->size[i]);
    return longest > 0.0 ? longest : cbrt(body->mass / body->material.density);
}

/* Half the thickness of a bar, or the smallest radius of a compact body's surface. */
static double scale_of(const struct body *body)
{
    return body->radius > 0.0 ? body->radius : body_smallest_radius(body);
}

/* Half of the longer side of a bar's section: how far waves go within it. */
static double half_section(const struct body *body)
{
    return body->radius > 0.0 ? body->radius : 0.5 * larger(body->width, body->height);
}

/* A body that vibrates as a rod or beam does; any other one as its mesh says, regular compliance
 * included. */
static bool is_bar(const struct body *body)
{
    return body_is_flexible(body) && body->length > 0.0 && !body_is_solid(body);
}

static bool without_shear(const struct body *body)
{
    return body_bends(body) && body->theory == THEORY_EULER_BERNOULLI;
}

/* Of a beam's side with its own compliance in series. */
static double unknown_of_side(const struct body *body, const struct site *site)
{
    double size = scale_of(body);
    double end = larger((0.5 * body->length - fabs(site->point[0])) / size, NEAREST_EDGE);
    double sum = UNKNOWN_MATCHED + SIDE_END / (end * end);
    if (body->radius > 0.0)
        return sum;
    /* across the face that is hit */
    int across = fabs(site->outward[2]) > fabs(site->outward[1]) ? 1 : 2;
    double half = 0.5 * (across == 1 ? body->width : body->height);
    double aside = fabs(site->point[across]) / half;
    double edge = larger((half - fabs(site->point[across])) / size, NEAREST_EDGE);
    double known = (1.0 - BEAM_SIDE_FARTHEST) * half / size;
    return sum + SIDE_ASIDE * aside * aside + SIDE_EDGE * larger(1.0 / edge - 1.0 / known, 0.0);
}

/* Missing modes of a broad beam that is hit on its side: it bends across as a plate does. */
static struct plate_across across_of(const struct problem *problem, size_t contact, int which,
                                     double duration)
{
    const struct body *body = problem_body(problem, contact, which);
    const struct site *site = &problem->sides[contact][which].site;
    double reduced = 1.0 / problem->w[contact * (problem->contact_count + 1)];
    if (!body_bends(body) || site->face != SITE_BEAM_SIDE || !(duration > 0.0))
        return (struct plate_across){0};
    bool on_top = fabs(site->outward[2]) > fabs(site->outward[1]);
    double depth = on_top ? body->height : body->width;
    double breadth = on_top ? body->width : body->height;
    if (!(breadth > BEAM_BROADEST * depth))
        return (struct plate_across){0};
    struct plate plate = {.material = &body->material,
                          .height = depth,
                          .sides = {body->length, breadth},
                          .at = {site->point[0], site->point[on_top ? 1 : 2]},
                          .mass = body->mass};
    return plate_across_of(&plate, reduced, duration);
}

/* Times E and the radius of the body. */
static double unknown_compliance(const struct problem *problem, const struct contact_side *side)
{
    const struct body *body = problem->bodies[side->body];
    if (body_bends(body) && side->site.face == SITE_BEAM_SIDE && !without_shear(body))
        return problem->compliance.bare ? UNKNOWN_SIDE : unknown_of_side(body, &side->site);
    if (problem->compliance.used == PERCUSS_COMPLIANCE_MATCHED)
        return UNKNOWN_MATCHED;
    if (!is_bar(body))
        return body_is_flexible(body) ? UNKNOWN_MATCHED : UNKNOWN_COMPACT;
    if (side->site.face == SITE_END)
        return UNKNOWN_HALF_SPACE;
    return UNKNOWN_WITHOUT_SHEAR;
}

/* Of a mesh, nearer to an edge than its element there is long, m/N. */
static double near_edge(const struct problem *problem, size_t contact, int which)
{
    const struct face_spot *spot = &problem->sides[contact][which].site.spot;
    if (!spot->on_mesh || !(spot->edge < spot->element))
        return 0.0;
    double young = problem_material(problem, contact, (unsigned)which)->young;
    return NEAR_MESH_EDGE / (young * larger(spot->edge, 0.1 * spot->element));
}

/* Of all bodies, or of those that vibrate; of an impact that lasts so long. */
static double compliance_of(const struct problem *problem, size_t contact, bool all,
                            double duration)
{
    double sum = 0.0;
    bool own = problem->contact_model.choices[contact].own;
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &problem->sides[contact][which];
        const struct body *body = problem->bodies[side->body];
        double size = scale_of(body);
        /* a law of the catalogue has the place's own flexibility */
        if (!own && isfinite(size) && (all || body_is_flexible(body)))
            sum += unknown_compliance(problem, side) / (body->material.young * size) +
                   near_edge(problem, contact, which) + side->load.family[0].mesh.unknown;
        sum += across_of(problem, contact, which, duration).compliance;
    }
    return sum;
}

/* Near clamped ends. */
static double clamps_of(const struct body *body, const struct site *site)
{
    double half = half_section(body), sum = 0.0;
    for (int end = 0; end < 2; end++) {
        double distance = 0.5 * body->length + (end == 0 ? 1.0 : -1.0) * site->point[0];
        double ratio = half / larger(distance, half);
        sum += body->supports[end] == SUPPORT_CLAMPED ? NEAR_CLAMP * ratio * ratio : 0.0;
    }
    return sum;
}

/* Of a bar's frequencies that the impact excites: as a stiffness it counts twice. */
static double theory_of(const struct body *body, const struct site *site, double duration)
{
    double ratio = half_section(body) / (wave_speed(body) * duration);
    if (!is_bar(body) || !isfinite(ratio))
        return 0.0;
    if (site->face == SITE_END)
        return (body->lateral_inertia ? THEORY_RAYLEIGH_LOVE : 1.0) * ratio * ratio;
    if (without_shear(body))
        return THEORY_WITHOUT_SHEAR * ratio;
    bool hutchinson = body->shear_rule == SHEAR_HUTCHINSON || body->shear_rule == SHEAR_ABSENT;
    return (hutchinson ? ratio * ratio : THEORY_COWPER * ratio) + clamps_of(body, site);
}

static double force_of(const struct problem *problem, size_t contact,
                       const struct model_impact *impact)
{
    double axes[2];
    const struct own_law *own = problem->contact_model.choices[contact].own;
    double sum = own ? own->deviation : 0.0;
    hertz_ellipse(&problem->hertz[contact], impact->force, axes);
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &problem->sides[contact][which];
        const struct body *body = problem->bodies[side->body];
        double ratio = own ? 0.0 : axes[0] / body_smallest_radius(body);
        sum = hypot(sum, PATCH * ratio * ratio);
        sum = hypot(sum, 2.0 * theory_of(body, &side->site, impact->duration));
    }
    return smaller(sum, 0.5);
}

/* Of the law, and of the work of unloading that an unknown compliance stores: C F^2 / 2 of 0.4 F
 * times the way back, and half of that in e. That of a compact body is in its size and shape. */
static double yield_of(const struct problem *problem, size_t contact,
                       const struct model_impact *impact)
{
    const struct contact_history *history = &impact->history;
    double parts[LAW_ERROR_COUNT];
    if (!(history->max_indentation > 0.0))
        return 0.0;
    law_error_parts(problem, contact, history, parts);
    /* a region of finite elements in every step has the shape of the table's, not its error */
    enum percuss_contact_model asked = problem->request->options.contact_model;
    if (contact_law_asked(asked)->method == CONTACT_CONCURRENT)
        parts[LAW_ERROR_LAW] = 0.0;
    double back = history->max_indentation - history->dent;
    double stored = 0.625 * compliance_of(problem, contact, false, impact->duration) *
                    history->max_force / back;
    return MEAN_TO_MOST * parts[LAW_ERROR_SIZE] + parts[LAW_ERROR_LAW] + parts[LAW_ERROR_RATE] +
           stored;
}

double model_impact_stiffness(const struct model_impact *impact)
{
    return impact->indentation > 0.0 ? HERTZ_MEAN_STIFFNESS * impact->force / impact->indentation
                                     : 0.0;
}

/* A contact that sticks swings along the surface on its tangential stiffness k, at w = sqrt(k W).
 * The waves that a half-space sends out damp that, by 0.38 lag k w of the impulse of a ball that
 * never slips, at 0.1 to 5 m/s (tests/unit/solve/test_deviation.c). */
static const double WAVES_ALONG = 0.5;

/* Of the tangential impulse, by the waves along half-spaces, which no scene has. */
static double waves_along(const struct problem *problem, const struct contact_friction *friction,
                          int tangent, double stiffness)
{
    size_t rows = problem_rows(problem);
    size_t index = (size_t)(friction - problem->friction);
    size_t row = problem->contact_count + 2 * index + (size_t)tangent;
    double lag = 0.0;
    for (int which = 0; which < 2; which++) {
        const struct body *body = problem_body(problem, friction->contact, which);
        if (body_solid(body).form == SOLID_HALF_SPACE)
            lag += half_space_waves_of(&body->material).lag_along;
    }
    return WAVES_ALONG * lag * stiffness * sqrt(stiffness * problem->row_w[row * (rows + 1)]);
}

/* What a body yields along its surface less than a half-space, m/N: of solids the modes know it, of
 * meshes the file does, but for interpolation and edges, as across; of a ball or a bar it is about
 * as much as across. */
static double unknown_along(const struct problem *problem, const struct contact_friction *friction,
                            int tangent, int which)
{
    const struct contact_side *side = &problem->sides[friction->contact][which];
    const struct body *body = problem->bodies[side->body];
    double size = scale_of(body);
    double mesh = friction->sides[tangent][which].load.family[0].mesh.unknown;
    if (body->mesh && body_is_flexible(body))
        return mesh + UNKNOWN_ALONG / (body->material.young * size) +
               near_edge(problem, friction->contact, which);
    if (body_is_solid(body) || !isfinite(size))
        return mesh;
    double share = !is_bar(body)                       ? UNKNOWN_COMPACT
                   : side->site.face == SITE_BEAM_SIDE ? UNKNOWN_SIDE
                   : side->site.face == SITE_END       ? UNKNOWN_HALF_SPACE
                                                       : UNKNOWN_WITHOUT_SHEAR;
    return mesh + share / (body->material.young * size);
}

struct deviation_along deviation_along(const struct problem *problem,
                                       const struct contact_friction *friction)
{
    const struct model_impact blow = model_impact_fastest(problem, friction->contact);
    struct deviation_along largest = {0.0, 0.0};
    for (int t = 0; t < 2; t++) {
        double stiffness = friction->ratio[2 * t] * model_impact_stiffness(&blow);
        double unknown =
            unknown_along(problem, friction, t, 0) + unknown_along(problem, friction, t, 1);
        largest.stiffness = larger(unknown * stiffness, largest.stiffness);
        largest.waves = larger(waves_along(problem, friction, t, stiffness), largest.waves);
    }
    return largest;
}

double deviation_stiffness(const struct deviation *deviation, const struct model_impact *impact)
{
    return hypot(deviation->force, deviation->compliance * model_impact_stiffness(impact));
}

struct stiffening deviation_stiffening(const struct deviation *deviation,
                                       const struct model_impact *impact)
{
    double all = deviation_stiffness(deviation, impact);
    if (!(all > 0.0))
        return (struct stiffening){0};
    double other = deviation->compliance * model_impact_stiffness(impact) / all;
    return (struct stiffening){.force = deviation->force / all * deviation->force,
                               .compliance = -other * deviation->compliance};
}

struct deviation deviation_of(const struct problem *problem, size_t contact,
                              const struct model_impact *impact)
{
    return (struct deviation){
        .force = force_of(problem, contact, impact),
        .compliance = compliance_of(problem, contact, true, impact->duration),
        .yield = yield_of(problem, contact, impact),
    };
}

struct model_impact model_impact_of(const struct problem *problem,
                                    const struct impact_outcome *outcome, size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    struct model_impact impact = {.force = outcome_peak_force(outcome, contact),
                                  .indentation = outcome_deepest(outcome, contact)};
    for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++)
        impact.duration = larger(track->list[i].end - track->list[i].start, impact.duration);
    if (contact_model_yielded(problem, outcome, contact))
        impact.history = outcome->laws[contact].history;
    return impact;
}

/* By a law of the catalogue. */
static struct model_impact own_impact(const struct contact_law *law, double work, double speed)
{
    double d = contact_law_depth(law, work), slope;
    return (struct model_impact){.force = contact_law_force(law, d, &slope),
                                 .indentation = d,
                                 .duration = speed > 0.0 ? HERTZ_DURATION * d / speed : INFINITY};
}

/* By Hertz's law. */
static struct model_impact elastic_impact(const struct problem *problem, size_t contact,
                                          double speed)
{
    const struct hertz_contact *hertz = &problem->hertz[contact];
    double work = 0.5 * speed * speed / problem->w[contact * (problem->contact_count + 1)];
    if (problem->contact_model.choices[contact].own && work > 0.0)
        return own_impact(&problem->contact_model.choices[contact].plastic, work, speed);
    double depth = pow(work / (HERTZ_WORK * hertz->stiffness), 0.4);
    return (struct model_impact){.force = hertz->stiffness * depth * sqrt(depth),
                                 .indentation = depth,
                                 .duration =
                                     speed > 0.0 ? HERTZ_DURATION * depth / speed : INFINITY};
}

struct model_impact model_impact_fastest(const struct problem *problem, size_t contact)
{
    return elastic_impact(problem, contact, problem_approach(problem));
}

/* The work of the approach, taken up by the contact's law from the beginning. */
struct model_impact model_impact_expected(const struct problem *problem, size_t contact)
{
    double speed = larger(-problem->gap_rate[contact], 0.0);
    double work = 0.5 * speed * speed / problem->w[contact * (problem->contact_count + 1)];
    struct model_impact impact = elastic_impact(problem, contact, speed);
    double depth = impact.indentation;
    /* by the law that yields, where it does */
    const struct contact_choice *choice = &problem->contact_model.choices[contact];
    if (choice->side < 0 || !(depth > choice->yield))
        return impact;
    struct contact_law law = choice->plastic;
    depth = contact_law_depth(&law, work);
    if (!(depth > law.history.max_indentation))
        return impact;
    contact_law_yield(&law, depth - law.history.dent);
    impact.history = law.history;
    impact.force = law.history.max_force;
    impact.indentation = law.history.max_indentation;
    return impact;
}

/* A flat or slender body as its normal force bends it: a box of the same height of section. False:
 * it has no such dimensions. */
static bool plate_of(const struct body *body, const struct site *site, struct plate *plate)
{
    const double *size = body->size, *at = site->point, *outward = site->outward;
    *plate = (struct plate){.material = &body->material, .mass = body->mass};
    if (size[0] > 0.0) {
        int normal = 0;
        for (int i = 1; i < 3; i++)
            normal = fabs(outward[i]) > fabs(outward[normal]) ? i : normal;
        int one = (normal + 1) % 3, other = (normal + 2) % 3;
        plate->height = size[normal];
        plate->sides[0] = size[one];
        plate->sides[1] = size[other];
        plate->at[0] = at[one];
        plate->at[1] = at[other];
        return true;
    }
    if (!(body->radius > 0.0 && body->length > 0.0))
        return false;
    if (fabs(outward[0]) > 0.5) {
        /* a disc: the square of its area, hit as near its edge */
        plate->height = body->length;
        plate->sides[0] = plate->sides[1] = sqrt(M_PI) * body->radius;
        plate->at[0] = 0.5 * sqrt(M_PI) * hypot(at[1], at[2]);
        return true;
    }
    /* a bar: of the same bending stiffness over its mass */
    plate->height = sqrt(3.0) * body->radius;
    plate->sides[0] = body->length;
    plate->sides[1] = 2.0 * body->radius;
    plate->at[0] = at[0];
    return true;
}

/* Of the energy, by a longitudinal wave along the longest dimension, excited by a force like half a
 * sine: 8 (reduced mass / mass) (way of a wave during the contact / length)^-4 (the envelope of
 * cos^2(omega T/2) / (1 - (omega T/pi)^2)^2). */
static double along_it(const struct body *body, double reduced, double duration)
{
    double ratio = extent(body) / (wave_speed(body) * duration);
    return 8.0 * smaller(reduced / body->mass, 1.0) * pow(ratio, 4.0);
}

double deviation_of_rigid(const struct problem *problem, size_t contact, int which,
                          const struct model_impact *impact)
{
    const struct body *body = problem_body(problem, contact, which);
    double reduced = 1.0 / problem->w[contact * (problem->contact_count + 1)];
    struct plate plate;
    if (body_is_flexible(body) || !isfinite(body->mass) || !(impact->duration > 0.0))
        return 0.0;
    double along = smaller(along_it(body, reduced, impact->duration), 1.0);
    double bent = plate_of(body, &problem->sides[contact][which].site, &plate)
                      ? MEAN_TO_MOST * plate_share(&plate, reduced, impact->duration)
                      : 0.0;
    /* e^2 = 1 - share, and e = exp(-share / 2) where waves leave */
    return 1.0 - sqrt(1.0 - along) * exp(-0.5 * bent);
}

double deviation_ringing(const struct problem *problem, size_t contact,
                         const struct model_impact *impact)
{
    double kept = 1.0;
    for (int which = 0; which < 2; which++) {
        double across = across_of(problem, contact, which, impact->duration).share;
        kept *= 1.0 - deviation_of_rigid(problem, contact, which, impact);
        kept *= exp(-0.5 * MEAN_TO_MOST * across);
    }
    return 1.0 - kept;
}

/* Share of the waves of a half-space that a bar's theory lacks. At its end: all until they
 * come back from the sides, later by the square of the rest of that way (as the frequencies of
 * the theory go). On its side, of bars on and beside the axis: 0.7, 0.45, 0.15 and 0.05 where they
 * go 1.8, 2.4, 3 and 4 times its depth or breadth meanwhile. */
static double of_bar(const struct body *body, const struct site *site, double duration)
{
    bool on_end = site->face == SITE_END;
    double way = (on_end ? 2.0 : 2.2 * 2.0) * half_section(body);
    double ratio = way / (wave_speed(body) * duration);
    return smaller(on_end ? ratio * ratio : pow(ratio, 4.0), 1.0);
}

/* Share of int F'^2 dt of a Hertz contact beyond a frequency, times its duration. The spectrum has
 * 0.95, 0.52, 0.099, 0.028 and 0.0083 of it beyond 2, 5, 8, 10 and 20. */
static double faster_than(double angle)
{
    double slow = exp(-pow(angle / 5.84, 2.7)), tail = 3.0 / (angle * angle);
    return smaller(larger(slow, tail), 1.0);
}

/* The modes of a block or mesh have the waves up to where they end. */
static double of_solid(const struct assembly *assembly, size_t body, size_t contact,
                       double duration)
{
    for (size_t p = 0; p < assembly->part_count; p++) {
        const struct omitted_part *part = &assembly->parts[p];
        if (part->body == body && part->row == contact)
            return faster_than(part->omega * duration);
    }
    return 0.0;
}

double deviation_waves(const struct problem *problem, const struct assembly *assembly,
                       const struct impact_outcome *outcome, size_t contact,
                       const struct model_impact *impact)
{
    double sum = 0.0;
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &problem->sides[contact][which];
        const struct body *body = problem->bodies[side->body];
        if (!body_is_flexible(body) || !(impact->duration > 0.0))
            continue;
        double weight = is_bar(body) ? of_bar(body, &side->site, impact->duration)
                                     : of_solid(assembly, side->body, contact, impact->duration);
        if (weight < NEGLIGIBLE)
            continue;
        sum +=
            weight * half_space_waves_of(&body->material).lag * outcome->tracks[contact].viscosity;
    }
    return sum;
}

static bool is_shifted(const double *shift)
{
    return shift[SOLVE_SHIFT_FORCE] != 0.0 || shift[SOLVE_SHIFT_COMPLIANCE] != 0.0 ||
           shift[SOLVE_SHIFT_YIELD] != 0.0;
}

/* One contact, by its expected impact: that of the answer is not known yet. */
static void shift_contact(struct problem *problem, size_t c)
{
    const double *shift = problem->request->model_shift;
    struct contact_law *law = &problem->contact_model.laws[c];
    struct model_impact impact = model_impact_expected(problem, c);
    struct deviation deviation = deviation_of(problem, c, &impact);
    /* the law's force and the compliance behind it */
    double force = shift[SOLVE_SHIFT_FORCE] * deviation.force / DEVIATION_SIGMAS;
    double yield = 1.0;
    problem->shift[c] = shift[SOLVE_SHIFT_COMPLIANCE] * deviation.compliance / DEVIATION_SIGMAS;
    /* the stress of yield, where it matters */
    if (law->operations->curve && deviation.yield > 0.0) {
        double share = fabs(shift[SOLVE_SHIFT_YIELD]) * deviation.yield / DEVIATION_SIGMAS;
        yield = law_error_yield(law, impact.history.max_indentation, share);
        if (shift[SOLVE_SHIFT_YIELD] < 0.0)
            yield = 1.0 / yield;
    }
    *law = contact_law_rescaled(law, exp(force), yield);
}

enum percuss_status deviation_shift(struct problem *problem, struct fault *fault)
{
    size_t n = problem->contact_count;
    if (!is_shifted(problem->request->model_shift))
        return PERCUSS_OK;
    problem->shift = arena_take(problem->arena, n, sizeof *problem->shift);
    if (!problem->shift)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t c = 0; c < n; c++)
        shift_contact(problem, c);
    return PERCUSS_OK;
}
