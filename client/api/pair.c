/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Places two bodies so that they touch at their default sites. All site normals are axes of the
 * body but for sites with names, so every other rotation is a quarter or a half turn. */

#include <math.h>
#include <percuss/server.h>
#include <stdio.h>
#include <string.h>

#include "error.h"

/* A point of the surface with its outward normal, in some frame. */
struct site {
    double point[3];
    double normal[3];
};

struct percuss_pair percuss_pair_default(const struct percuss_body *a, const struct percuss_body *b)
{
    return (struct percuss_pair){.a = a, .b = b, .at_a = 0.5, .at_b = 0.5};
}

/* The site on the face at +axis (side 1) or -axis (side -1). */
static struct site face_site(const struct percuss_body *body, int axis, double side)
{
    struct site site = {0};
    site.point[axis] = side * body->half_extents[axis];
    site.normal[axis] = side;
    return site;
}

/* The site of that name, or the first one. */
static enum percuss_result named_site(const struct percuss_body *body, const char *name,
                                      struct site *site)
{
    char known[400] = "";
    for (size_t i = 0; i < body->site_count; i++) {
        const struct percuss_site *one = &body->sites[i];
        size_t length = strlen(known);
        if (!name || strcmp(name, one->name) == 0) {
            memcpy(site->point, one->point, sizeof site->point);
            memcpy(site->normal, one->normal, sizeof site->normal);
            return PERCUSS_RESULT_OK;
        }
        snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "", one->name);
    }
    if (name && body->site_count > 0)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "site: '%s': %s has the sites %s", name,
                         body->id, known);
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                     "%s: a body of shape '%s' has no sites with names: declare some in the "
                     "catalogue, or send a whole request",
                     body->id, body->shape);
}

/* The default site in the body frame; false for an unknown shape. */
static bool default_site(const struct percuss_body *body, double at, struct site *site)
{
    enum { X, Z = 2 };
    if (!strcmp(body->shape, "rod")) {
        bool far_end_is_free = body->supports[1] == PERCUSS_SUPPORT_FREE;
        *site = face_site(body, X, far_end_is_free ? 1.0 : -1.0);
    } else if (!strcmp(body->shape, "cylinder")) {
        *site = face_site(body, X, 1.0);
    } else if (!strcmp(body->shape, "beam")) {
        *site = face_site(body, Z, 1.0);
        site->point[X] = (2.0 * at - 1.0) * body->half_extents[X];
    } else if (!strcmp(body->shape, "sphere") || !strcmp(body->shape, "block") ||
               !strcmp(body->shape, "half-space")) {
        *site = face_site(body, Z, 1.0);
    } else {
        return false;
    }
    return true;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

/* R(q) v = v + 2 w (u x v) + 2 u x (u x v) with q = (w, u). */
static void rotate(const double q[4], const double v[3], double result[3])
{
    double once[3], twice[3];
    cross(q + 1, v, once);
    cross(q + 1, once, twice);
    for (int i = 0; i < 3; i++)
        result[i] = v[i] + 2.0 * (q[0] * once[i] + twice[i]);
}

static bool is_axis(const double v[3])
{
    return fabs(v[0]) == 1.0 || fabs(v[1]) == 1.0 || fabs(v[2]) == 1.0;
}

/* Between any unit vectors: half way between no turn (1, 0) and twice the turn (cosine, sine). Of
 * the half turns one about an axis across `from`. */
static void any_rotation(const double from[3], const double to[3], double q[4])
{
    const double least = 1e-12; /* of 1 + cosine: a half turn but for rounding */
    double sine[3], share = 1.0 + dot(from, to);
    cross(from, to, sine);
    if (share < least) {
        double axis[3] = {0.0, 0.0, 0.0};
        axis[fabs(from[0]) < 0.6 ? 0 : 1] = 1.0;
        cross(from, axis, sine);
        share = 0.0;
    }
    double length = sqrt(share * share + dot(sine, sine));
    q[0] = share / length;
    for (int i = 0; i < 3; i++)
        q[1 + i] = sine[i] / length;
}

/* The smallest rotation that takes `from` to `to`, exact where both are axes. Of the half turns it
 * takes the one about x for +-z and the one about y for +-x. */
static void smallest_rotation(const double from[3], const double to[3], double q[4])
{
    double cosine = dot(from, to), sine[3];
    if (!is_axis(from) || !is_axis(to)) {
        any_rotation(from, to, q);
        return;
    }
    cross(from, to, sine);
    if (cosine > 0.5) {
        q[0] = 1.0;
        q[1] = q[2] = q[3] = 0.0;
    } else if (cosine < -0.5) {
        q[0] = 0.0;
        for (int i = 0; i < 3; i++)
            q[1 + (i + 1) % 3] = fabs(from[i]);
    } else {
        q[0] = M_SQRT1_2;
        for (int i = 0; i < 3; i++)
            q[1 + i] = M_SQRT1_2 * sine[i];
    }
}

static bool both_beams(const struct percuss_pair *pair)
{
    return !strcmp(pair->a->shape, "beam") && !strcmp(pair->b->shape, "beam");
}

static enum percuss_result check_pair(const struct percuss_pair *pair)
{
    if (!pair->a || !pair->b)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "pair.%c: NULL: a body is needed; percuss_body_find returns NULL for an "
                         "id that its list has not",
                         pair->a ? 'b' : 'a');
    if (!(pair->speed > 0.0) || !isfinite(pair->speed))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "speed: %g: a finite number of m/s > 0 is needed", pair->speed);
    if (!(fabs(pair->angle) < M_PI_2))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "angle: %g rad: more than -pi/2 and less than pi/2 is needed, from the "
                         "normal",
                         pair->angle);
    if (!isfinite(pair->spin))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "spin: %g rad/s: must be finite",
                         pair->spin);
    const double at[] = {pair->at_a, pair->at_b};
    for (int i = 0; i < 2; i++)
        if (!(at[i] >= 0.0 && at[i] <= 1.0))
            return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "at: %g: a fraction 0..1 is needed",
                             at[i]);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result find_site(const struct percuss_body *body, double at, const char *name,
                                     struct site *site)
{
    if (name || !strcmp(body->shape, "mesh"))
        return named_site(body, name, site);
    if (default_site(body, at, site))
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                     "%s: a body of shape '%s' has no default site; send a whole request", body->id,
                     body->shape);
}

/* The world axis that is least parallel to the normal, made normal to it. */
static void first_tangent(const double normal[3], double tangent[3])
{
    int least = 0;
    for (int i = 1; i < 3; i++)
        least = fabs(normal[i]) < fabs(normal[least]) ? i : least;
    double length = sqrt(1.0 - normal[least] * normal[least]);
    for (int i = 0; i < 3; i++)
        tangent[i] = ((i == least) - normal[least] * normal[i]) / length;
}

/* Leans A's flight, and turns A; a straight one is left as it is to the bit. */
static void lean(const struct percuss_pair *pair, struct percuss_body_motion *a,
                 struct percuss_contact *contact)
{
    double across[3];
    contact->friction = pair->friction;
    if (pair->angle == 0.0 && pair->spin == 0.0)
        return;
    first_tangent(contact->normal, contact->tangent);
    cross(contact->tangent, contact->normal, across);
    for (int i = 0; i < 3; i++) {
        a->velocity[i] = pair->speed * (sin(pair->angle) * contact->tangent[i] -
                                        cos(pair->angle) * contact->normal[i]);
        a->angular_velocity[i] = pair->spin * across[i];
    }
}

enum percuss_result percuss_contact_pair(const struct percuss_pair *pair,
                                         struct percuss_request *request)
{
    struct site site_a, site_b;
    if (ERROR_NULL(pair, request))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    /* where each of them is hit, in its own axes */
    enum percuss_result result = check_pair(pair);
    if (result == PERCUSS_RESULT_OK)
        result = find_site(pair->a, pair->at_a, pair->site_a, &site_a);
    if (result == PERCUSS_RESULT_OK)
        result = find_site(pair->b, pair->at_b, pair->site_b, &site_b);
    if (result != PERCUSS_RESULT_OK)
        return result;

    percuss_request_init(request);
    struct percuss_body_motion *a = percuss_request_add_body(request, pair->a->id);
    percuss_request_add_body(request, pair->b->id);
    struct percuss_contact *contact = percuss_request_add_contact(request, 0, 1);

    /* B stands unrotated at the origin, so its site is the contact in the world */
    memcpy(contact->point, site_b.point, sizeof contact->point);
    memcpy(contact->normal, site_b.normal, sizeof contact->normal);

    /* A is turned to face B and approaches along the normal */
    double facing[3], arm[3];
    for (int i = 0; i < 3; i++)
        facing[i] = 0.0 - site_b.normal[i]; /* not -0 */
    /* crossed beams: z to -z and x to y is the half turn about the diagonal of x and y */
    if (both_beams(pair))
        memcpy(a->orientation, (double[4]){0.0, M_SQRT1_2, M_SQRT1_2, 0.0}, sizeof a->orientation);
    else
        smallest_rotation(site_a.normal, facing, a->orientation);
    rotate(a->orientation, site_a.point, arm);
    for (int i = 0; i < 3; i++) {
        a->position[i] = contact->point[i] - arm[i];
        a->velocity[i] = pair->speed * facing[i];
    }
    lean(pair, a, contact);
    return PERCUSS_RESULT_OK;
}
