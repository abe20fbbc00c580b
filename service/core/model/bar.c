/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/bar.h"

#include <math.h>

#include "model/damping.h"

static const double NEGLIGIBLE = 1e-9;

void bar_complete_round(struct body *body)
{
    double r = body->radius, length = body->length;
    double area = M_PI * r * r;
    body->mass = body->material.density * area * length;
    body->inertia[0] = 0.5 * body->mass * r * r;
    body->inertia[1] = body->inertia[2] = body->mass * (3.0 * r * r + length * length) / 12.0;
}

int bar_round_faces(const struct body *body, double tip_radius, const double p[3],
                    struct face *faces)
{
    double half = 0.5 * body->length;
    for (int end = 0; end < 2; end++) {
        double sign = end == 0 ? -1.0 : 1.0;
        if (isfinite(tip_radius))
            face_ball(sign * (half - tip_radius), tip_radius, p, &faces[end]);
        else
            face_plane(0, sign, half, p, &faces[end]);
        faces[end].kind = SITE_END;
        faces[end].beyond = sign * p[0] > 0.0 ? hypot(p[1], p[2]) - body->radius : INFINITY;
    }
    face_bar_side(body->radius, half, p, &faces[2]);
    return 3;
}

/* tip - sqrt(tip^2 - r^2), without the difference of large numbers. */
static double cap_height(const struct body *body)
{
    double r = body->radius, tip = body->tip_radius;
    return isfinite(tip) ? r * r / (tip + sqrt(tip * tip - r * r)) : 0.0;
}

enum percuss_status bar_check_tips(const struct body *body, struct fault *fault)
{
    bool covered = body->tip_radius >= body->radius;
    if (covered && body->length >= 2.0 * cap_height(body))
        return PERCUSS_OK;
    if (covered)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "length: %.9g: must be at least %.9g m, the height of both caps of "
                         "tip_radius %.9g m",
                         body->length, 2.0 * cap_height(body), body->tip_radius);
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "tip_radius: %.9g: must be at least radius (%.9g m); absent: flat ends",
                     body->tip_radius, body->radius);
}

/* A cap of height h has the volume pi h (3 r^2 + h^2) / 6. */
double bar_cap_loss(const struct body *body)
{
    double h = cap_height(body), ratio = h > 0.0 ? h / body->radius : 0.0;
    return h * (0.5 - ratio * ratio / 6.0);
}

double bar_cap_section(const struct body *body, const struct site *site)
{
    return copysign(0.5 * body->length - cap_height(body), site->point[0]);
}

const char *bar_why_not(const struct body *body, const struct site *site)
{
    bool on_end = site->face == SITE_END || fabs(site->outward[0]) > 0.5;
    if (on_end && body->supports[site->point[0] > 0.0] != SUPPORT_FREE)
        return "this end is held by a support: hit the free end or the side";
    return NULL;
}

double bar_place(const struct body *body, const struct site *site)
{
    double half = 0.5 * body->span;
    return site->face == SITE_END ? copysign(half, site->point[0])
                                  : fmax(-half, fmin(half, site->point[0]));
}

void bar_load_along(const struct body *body, const struct site *site, const double direction[3],
                    bool tangential, struct family_load *load)
{
    load->bar.x = bar_place(body, site);
    load->bar.force = tangential || site->face == SITE_END ? direction[0] : 0.0;
    bar_load_settle(body, load);
}

void bar_load_settle(const struct body *body, struct family_load *load)
{
    double moment = fabs(load->bar.moment);
    bool pushes = fabs(load->bar.force) > NEGLIGIBLE;
    /* without a force it is of second order in the section's size */
    if (!pushes)
        load->bar.curvature = 0.0;
    load->acts = pushes || (moment > 0.0 && moment / body_smallest_radius(body) > NEGLIGIBLE);
}

void bar_describe_ends(const struct body *body, struct body_description *description)
{
    static const char *const names[] = {"free", "pinned", "clamped"};
    describe_add(description, "ends %s and %s", names[body->supports[0]], names[body->supports[1]]);
    damping_describe(body, description);
    if (body->modes > 0)
        describe_add(description, "%u modes", body->modes);
}
