/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "model/bar.h"
#include "model/bar_waves.h"
#include "model/beam.h"
#include "model/key.h"
#include "model/mesh_family.h"
#include "model/ritz.h"

static const char *const ends[] = {
    [SUPPORT_FREE] = "free",
    [SUPPORT_PINNED] = "pinned",
    [SUPPORT_CLAMPED] = "clamped",
};
static const char *const theories[] = {
    [THEORY_TIMOSHENKO] = "timoshenko",
    [THEORY_EULER_BERNOULLI] = "euler-bernoulli",
};
static const char *const shear_rules[] = {
    [SHEAR_ABSENT] = NULL,
    [SHEAR_COWPER] = "cowper",
    [SHEAR_HUTCHINSON] = "hutchinson",
};
static const struct key section[] = {
    {"width", KEY_NUMBER, &limit_length, true, KEY_OF(body, width), KEY_SAYS(NULL, "along y")},
    {"height", KEY_NUMBER, &limit_length, true, KEY_OF(body, height), KEY_SAYS(NULL, "along z")},
};
static const struct key_table keys_section = {"a section", section, 2, NULL};
static const struct key keys[] = {
    {"radius", KEY_NUMBER, &limit_length, KEY_OF(body, radius), .instead = {"diameter", "section"},
     KEY_SAYS("diameter or section stands instead", "of a round section")},
    {"diameter", KEY_TWICE, &limit_diameter, KEY_OF(body, radius),
     KEY_SAYS("radius or section stands instead", "twice the radius")},
    {"section", KEY_SECTION, .nested = &keys_section,
     KEY_SAYS("radius or diameter stands instead",
              "a rectangular section; the vibration of a beam more than 2.5 times as broad as deep "
              "is a block's unless an end is pinned or shear_factor is stated")},
    {"length", KEY_NUMBER, &limit_length, true, KEY_OF(body, length),
     KEY_SAYS(NULL, "along its axis, which is x")},
    {"tip_radius", KEY_NUMBER, &limit_length, KEY_OF(body, tip_radius), .absent = INFINITY,
     KEY_SAYS("flat ends", "of round caps on the ends of a round section; at least radius")},
    {"theory", KEY_WORD, KEY_OF(body, theory), KEY_WORDS(theories),
     KEY_SAYS("timoshenko",
              "theory of its bending: with shear and rotation of the section, or without")},
    {"shear_factor", KEY_SHEAR, &limit_shear_factor, KEY_OF(body, shear_rule),
     KEY_WORDS(shear_rules),
     KEY_SAYS("hutchinson",
              "shear factor of timoshenko's theory: by Cowper's rule, Hutchinson's, or as stated")},
    {"ends", KEY_ENDS, KEY_OF(body, supports), KEY_WORDS(ends),
     KEY_SAYS("free",
              "how its ends at -x and +x are held; a pinned or clamped one holds the twist too")},
    {"damping", KEY_NUMBER, &limit_damping, KEY_OF(body, damping),
     KEY_SAYS("half of its material's loss factor (of its relaxation at each mode's frequency); 0 "
              "where that states none",
              "damping ratio of every mode")},
    {"modes", KEY_WHOLE, &limit_modes, KEY_OF(body, modes),
     KEY_SAYS("as many as the tolerance asks for", "fixed number of modes")},
};

/* A beam of the catalogue with the vibration of a block. */
static const struct body_kind strip_kind;

static bool is_round(const struct body *body)
{
    return body->radius > 0.0;
}

static enum percuss_status beam_check(const struct body *body, struct fault *fault)
{
    if (is_round(body) && (body->width != 0.0 || body->height != 0.0))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "section: %.9g x %.9g: must be absent beside radius (%.9g m)", body->width,
                         body->height, body->radius);
    if (is_round(body))
        return bar_check_tips(body, fault);
    if (isfinite(body->tip_radius))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "tip_radius: %.9g: must be absent beside section: caps are of a round one",
                         body->tip_radius);
    enum percuss_status status = limit_check(&limit_length, "section.width", body->width, fault);
    return status ? status : limit_check(&limit_length, "section.height", body->height, fault);
}

/* Sections: circle I = pi r^4/4; rectangle, deflection along y: height width^3/12. Rotation about y
 * goes with deflection along z. */
static void complete_section(struct body *body)
{
    body->span = body->length - 2.0 * bar_cap_loss(body);
    double length = body->span;
    double *second = body->second_moment;
    /* the section */
    if (is_round(body)) {
        double r2 = body->radius * body->radius;
        body->area = M_PI * r2;
        second[0] = second[1] = 0.25 * M_PI * r2 * r2;
    } else {
        double w = body->width, h = body->height;
        body->area = w * h;
        second[0] = h * w * w * w / 12.0;
        second[1] = w * h * h * h / 12.0;
    }
    /* mass and twist */
    body->mass = body->material.density * body->area * length;
    body->torsion_constant = torsion_constant(body);
    body->warping_constant = torsion_warping_constant(body);

    /* inertia: Euler-Bernoulli's sections carry none in bending */
    bool rotatory = body->theory == THEORY_TIMOSHENKO;
    double slender = length * length / 12.0;
    body->inertia[0] = body->mass * (second[0] + second[1]) / body->area;
    body->inertia[1] = body->mass * (slender + (rotatory ? second[1] / body->area : 0.0));
    body->inertia[2] = body->mass * (slender + (rotatory ? second[0] / body->area : 0.0));
}

static double cowper_factor(const struct body *body)
{
    double poisson = body->material.poisson;
    return is_round(body) ? beam_shear_cowper_circle(poisson)
                          : beam_shear_cowper_rectangle(poisson);
}

/* For deflection along y or z. */
static double hutchinson_factor(const struct body *body, int along)
{
    double poisson = body->material.poisson, w = body->width, h = body->height;
    if (is_round(body))
        return beam_shear_hutchinson_circle(poisson);
    return along == 0 ? beam_shear_hutchinson_rectangle(poisson, w, h)
                      : beam_shear_hutchinson_rectangle(poisson, h, w);
}

/* Three-dimensional finite elements of a round bar have Hutchinson's frequencies to 2e-5 (first)
 * and 1.6e-3 (28 kHz); Cowper's are 1 % low. Flat strips (a width of 2.4 heights at poisson 0.3)
 * and strongly auxetic metals come near a pole of Hutchinson's quotient, with a factor above 1:
 * there Cowper's is used. */
static double default_factor(const struct body *body, int along)
{
    double factor = hutchinson_factor(body, along);
    return factor > 0.0 && factor <= 1.0 ? factor : cowper_factor(body);
}

static void shear_factors(struct body *body)
{
    for (int along = 0; along < 2; along++) {
        double *factor = &body->shear_factor[along];
        switch (body->shear_rule) {
        case SHEAR_ABSENT:
            *factor = default_factor(body, along);
            break;
        case SHEAR_COWPER:
            *factor = cowper_factor(body);
            break;
        case SHEAR_HUTCHINSON:
            *factor = hutchinson_factor(body, along);
            break;
        case SHEAR_NUMBER:
            *factor = body->shear_number;
            break;
        }
    }
}

/* A strip bends across its breadth too: its vibration is computed as a block's, unless the
 * catalogue states a theory of beams or a shear factor, or pins an end, which a block cannot have.
 */
static void choose_kind(struct body *body)
{
    double w = body->width, h = body->height;
    struct ritz_shape shape;
    bool broad = !is_round(body) && fmax(w, h) > BEAM_BROADEST * fmin(w, h);
    bool pinned = body->supports[0] == SUPPORT_PINNED || body->supports[1] == SUPPORT_PINNED;
    bool asked = body->theory != THEORY_TIMOSHENKO || body->shear_rule != SHEAR_ABSENT;

    bool strip = broad && !pinned && !asked;
    const double size[3] = {body->length, w, h};
    for (int i = 0; i < 3; i++)
        body->size[i] = strip ? size[i] : 0.0;
    body->kind = strip && mesh_family_box(body, &shape) ? &strip_kind : &beam_kind;
}

static enum percuss_status beam_complete(struct body *body, struct fault *fault)
{
    complete_section(body);
    choose_kind(body);
    if (body->theory == THEORY_EULER_BERNOULLI)
        return PERCUSS_OK;
    shear_factors(body);
    const double *factor = body->shear_factor;
    if (limit_holds(&limit_shear_factor, factor[0]) && limit_holds(&limit_shear_factor, factor[1]))
        return PERCUSS_OK;
    if (body->shear_rule == SHEAR_NUMBER)
        return limit_check(&limit_shear_factor, "shear_factor", body->shear_number, fault);
    /* Hutchinson's quotient has a pole in the auxetic range, near poisson -0.79 for a circle */
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "shear_factor: %s: must be a number here: with poisson %.9g the rule gives "
                     "%.9g and %.9g, beyond 1e-3 to 2",
                     shear_rules[body->shear_rule], body->material.poisson, factor[0], factor[1]);
}

static double beam_smallest_radius(const struct body *body)
{
    double across = is_round(body) ? body->radius : 0.5 * fmin(body->width, body->height);
    return fmin(fmin(across, body->tip_radius), 0.5 * body->length);
}

static int beam_faces(const struct body *body, const double p[3], struct face *faces)
{
    const double half[3] = {0.5 * body->length, 0.5 * body->width, 0.5 * body->height};
    if (body->kind->box)
        return face_box(half, p, faces);
    int count = is_round(body) ? bar_round_faces(body, body->tip_radius, p, faces)
                               : face_box(half, p, faces);
    for (int i = 0; i < count; i++)
        faces[i].kind = i < 2 ? SITE_END : SITE_BEAM_SIDE;
    return count;
}

static const struct mode_family *const families[] = {
    [BAR_LONGITUDINAL] = &longitudinal_family,
    [BAR_BENDING_Y] = &beam_bending_family,
    [BAR_BENDING_Z] = &beam_bending_family,
    [BAR_TWIST] = &beam_twist_family,
};

/* A section that turns by psi moves a point at the height y and at x in front of it by -psi y along
 * the axis and by psi x across it: so the force on a cap acts on the section under the cap, with
 * its lever arm, and so does a tangential force on the side. A hit on the side of a rectangular
 * section twists it about the axis; without friction one on a round section or on an end does not.
 */
static void beam_load(const struct body *body, const struct site *site, const double direction[3],
                      bool tangential, struct site_load *load)
{
    bool on_end = site->face == SITE_END;
    double x = bar_place(body, site);
    double at = on_end ? bar_cap_section(body, site) : x;
    const double *point = site->point;
    /* along the axis */
    bar_load_along(body, site, direction, tangential, &load->family[BAR_LONGITUDINAL]);
    /* across it, in both planes */
    for (int plane = 0; plane < 2; plane++) {
        struct family_load *bending = &load->family[BAR_BENDING_Y + plane];
        if (!on_end)
            bending->bar = beam_side_load(body, plane, point, direction);
        bending->bar.x = at;
        bending->bar.force = direction[1 + plane];
        if (on_end || tangential)
            bending->bar.moment =
                (point[0] - at) * direction[1 + plane] - point[1 + plane] * direction[0];
        bar_load_settle(body, bending);
    }
    /* about it */
    struct family_load *twist = &load->family[BAR_TWIST];
    twist->bar.x = x;
    if (tangential || (!is_round(body) && !on_end))
        twist->bar.moment = point[1] * direction[2] - point[2] * direction[1];
    bar_load_settle(body, twist);
}

/* Round and square sections bend alike in all planes through the axis. */
static bool beam_alike(const struct body *body, size_t *first)
{
    *first = BAR_BENDING_Y;
    return body->second_moment[0] == body->second_moment[1] &&
           (body->theory != THEORY_TIMOSHENKO || body->shear_factor[0] == body->shear_factor[1]);
}

static const char *beam_theory_name(const struct body *body)
{
    return theories[body->theory];
}

static void beam_describe(const struct body *body, struct body_description *description)
{
    describe_add(description, "length %g m", body->length);
    if (is_round(body)) {
        describe_extents(description, 0.5 * body->length, body->radius, body->radius);
        describe_add(description, "radius %g m", body->radius);
        if (isfinite(body->tip_radius)) {
            description->tip_radius = body->tip_radius;
            describe_add(description, "tip radius %g m", body->tip_radius);
        }
    } else {
        describe_extents(description, 0.5 * body->length, 0.5 * body->width, 0.5 * body->height);
        describe_add(description, "section %g m x %g m", body->width, body->height);
    }
    if (body->kind->box)
        describe_add(description, "as a block: broader than %g depths", BEAM_BROADEST);
    else if (body->theory == THEORY_TIMOSHENKO)
        describe_add(description, "Timoshenko, shear factor %.4g", body->shear_factor[1]);
    else
        describe_add(description, "Euler-Bernoulli");
    bar_describe_ends(body, description);
}

/* A beam of the catalogue, whichever theory its vibration has. */
#define BEAM_MEMBERS                                                                               \
    .name = "beam", .keys = keys, .key_count = sizeof keys / sizeof *keys, .check = beam_check,    \
    .complete = beam_complete, .smallest_radius = beam_smallest_radius, .faces = beam_faces,       \
    .why_not = bar_why_not, .describe = beam_describe

const struct body_kind beam_kind = {
    .families = families,
    .family_count = sizeof families / sizeof *families,
    .load = beam_load,
    .alike = beam_alike,
    .theory = beam_theory_name,
    BEAM_MEMBERS,
};

/* A strip: its vibration is a block's. */
static const struct body_kind strip_kind = {
    BEAM_MEMBERS,
    BOX_VIBRATION,
    .box = mesh_family_box,
};
