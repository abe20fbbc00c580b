/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>

#include "base/extremes.h"
#include "model/bar.h"
#include "model/bar_waves.h"
#include "model/key.h"

static const char *const ends[] = {
    [SUPPORT_FREE] = "free",
    [SUPPORT_CLAMPED] = "fixed",
};
static const struct key keys[] = {
    {"radius", KEY_NUMBER, &limit_length, true, KEY_OF(body, radius), .instead = {"diameter"},
     KEY_SAYS("diameter stands instead", "of its round section")},
    {"diameter", KEY_TWICE, &limit_diameter, KEY_OF(body, radius),
     KEY_SAYS("radius stands instead", "twice the radius")},
    {"length", KEY_NUMBER, &limit_length, true, KEY_OF(body, length),
     KEY_SAYS(NULL, "along its axis, which is x")},
    {"tip_radius", KEY_NUMBER, &limit_length, KEY_OF(body, tip_radius), .absent = INFINITY,
     KEY_SAYS("flat ends", "of round caps on its ends; at least radius")},
    {"lateral_inertia", KEY_FLAG, KEY_OF(body, lateral_inertia),
     KEY_SAYS("false", "Love's correction: the section moves in and out as waves pass")},
    {"ends", KEY_ENDS, KEY_OF(body, supports), KEY_WORDS(ends),
     KEY_SAYS("free", "how its ends at -x and +x are held")},
    {"damping", KEY_NUMBER, &limit_damping, KEY_OF(body, damping),
     KEY_SAYS("half of its material's loss factor (of its relaxation at each mode's frequency); 0 "
              "where that states none",
              "damping ratio of every mode")},
    {"modes", KEY_WHOLE, &limit_modes, KEY_OF(body, modes),
     KEY_SAYS("as many as the tolerance asks for", "fixed number of modes")},
};

static const struct mode_family *const families[] = {
    [BAR_LONGITUDINAL] = &longitudinal_family,
};

static enum percuss_status rod_complete(struct body *body, struct fault *fault)
{
    (void)fault;
    bar_complete_round(body);
    body->area = M_PI * body->radius * body->radius;
    body->span = body->length;
    return PERCUSS_OK;
}

static double rod_smallest_radius(const struct body *body)
{
    return smaller(smaller(body->radius, body->tip_radius), 0.5 * body->length);
}

static int rod_faces(const struct body *body, const double p[3], struct face *faces)
{
    int count = bar_round_faces(body, body->tip_radius, p, faces);
    faces[count - 1].kind = SITE_BEAM_SIDE;
    return count;
}

static const char *rod_why_not(const struct body *body, const struct site *site)
{
    if (site->face == SITE_BEAM_SIDE)
        return "a hit on the side bends it, and a rod has longitudinal waves only: declare it as "
               "shape: beam";
    if (hypot(site->point[1], site->point[2]) > 0.1 * body->radius)
        return "a hit beside the axis bends it (more than 10 % of the radius), and a rod has "
               "longitudinal waves only: declare it as shape: beam, which takes tip_radius too";
    return bar_why_not(body, site);
}

/* It has longitudinal waves only: a force across the axis moves it as a rigid body. */
static void rod_load(const struct body *body, const struct site *site, const double direction[3],
                     bool tangential, struct site_load *load)
{
    bar_load_along(body, site, direction, tangential, &load->family[BAR_LONGITUDINAL]);
}

static struct solid rod_solid(const struct body *body)
{
    return (struct solid){.form = SOLID_CYLINDER,
                          .radius = body->radius,
                          .length = body->length,
                          .across = body->radius,
                          .tip_radius = body->tip_radius};
}

static const char *rod_theory_name(const struct body *body)
{
    return body->lateral_inertia ? "rayleigh-love" : "rod";
}

static void rod_describe(const struct body *body, struct body_description *description)
{
    describe_extents(description, 0.5 * body->length, body->radius, body->radius);
    description->tip_radius = body->tip_radius;
    describe_add(description, "length %g m", body->length);
    describe_add(description, "radius %g m", body->radius);
    if (isinf(body->tip_radius))
        describe_add(description, "flat tips");
    else
        describe_add(description, "tip radius %g m", body->tip_radius);
    if (body->lateral_inertia)
        describe_add(description, "lateral inertia");
    bar_describe_ends(body, description);
}

const struct body_kind rod_kind = {
    .name = "rod",
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .check = bar_check_tips,
    .complete = rod_complete,
    .smallest_radius = rod_smallest_radius,
    .faces = rod_faces,
    .why_not = rod_why_not,
    .families = families,
    .family_count = sizeof families / sizeof *families,
    .load = rod_load,
    .solid = rod_solid,
    .theory = rod_theory_name,
    .describe = rod_describe,
};
