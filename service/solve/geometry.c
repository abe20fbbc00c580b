/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/geometry.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/rigid.h"
#include "model/vector.h"
#include "numeric/lcp.h"
#include "numeric/linear.h"

/* Faster approaches are outside everything that the models describe. */
static const double MAX_SPEED = 1e4;
/* So is a mass beyond these. */
static const double MIN_INVERSE_MASS = 1e-100;

/* Puts the body with the request's own parameters in its place. */
static enum percuss_status vary(const struct body **body, const struct solve_body *asked,
                                size_t index, struct arena *arena, struct fault *fault)
{
    struct body *varied = arena_take(arena, 1, sizeof *varied);
    struct fault reason = {0};
    if (!varied)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (body_vary(*body, asked->variations, asked->variation_count, varied, &reason))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bodies[%zu].overrides: %.500s", index,
                         reason.text);
    *body = varied;
    return PERCUSS_OK;
}

static enum percuss_status find_bodies(struct geometry *geometry, const struct body_set *catalogue,
                                       const struct solve_request *request, struct arena *arena,
                                       struct fault *fault)
{
    for (size_t i = 0; i < request->body_count; i++) {
        const struct solve_body *body = &request->bodies[i];
        geometry->bodies[i] = body_set_find(catalogue, body->id);
        if (!geometry->bodies[i])
            return fault_set(fault, PERCUSS_UNKNOWN_BODY,
                             "bodies[%zu].id: '%s': not in the catalogue (%zu bodies; percuss "
                             "bodies lists them)",
                             i, body->id, catalogue->count);
        enum percuss_status status = PERCUSS_OK;
        if (body->variation_count > 0)
            status = vary(&geometry->bodies[i], body, i, arena, fault);
        if (status)
            return status;
        memcpy(geometry->poses[i].position, body->position, sizeof body->position);
        rotation_matrix(body->orientation, geometry->poses[i].rotation);
    }
    return PERCUSS_OK;
}

static void point_velocity(const struct solve_body *body, const double point[3], double velocity[3])
{
    double arm[3];
    double turning[3];
    sub3(point, body->position, arm);
    cross3(body->angular_velocity, arm, turning);
    for (int i = 0; i < 3; i++)
        velocity[i] = body->velocity[i] + turning[i];
}

static enum percuss_status place_side(struct geometry *geometry,
                                      const struct solve_contact *contact, size_t index, int which,
                                      double allowed, struct fault *fault)
{
    struct contact_side *side = &geometry->sides[index][which];
    side->body = which == 0 ? contact->a : contact->b;
    const struct body *body = geometry->bodies[side->body];
    const struct pose *pose = &geometry->poses[side->body];
    /* the force pushes a along +n and b along -n; outward normals are the opposite */
    double push[3];
    double outward[3];
    char field[32];
    scale3(which == 0 ? 1.0 : -1.0, contact->normal, push);
    scale3(-1.0, push, outward);
    snprintf(field, sizeof field, "contacts[%zu]", index);
    enum percuss_status status =
        site_locate(body, pose, contact->point, outward, allowed, field, &side->site, fault);
    if (status)
        return status;
    rotate_back3(pose->rotation, push, side->direction);
    side->load = site_load_make(body, &side->site, side->direction);
    return PERCUSS_OK;
}

static enum percuss_status place_contact(struct geometry *geometry,
                                         const struct solve_request *request, size_t index,
                                         struct fault *fault)
{
    const struct solve_contact *contact = &request->contacts[index];
    const struct body *a = geometry->bodies[contact->a];
    const struct body *b = geometry->bodies[contact->b];
    double smallest = fmin(body_smallest_radius(a), body_smallest_radius(b));
    if (!isfinite(smallest))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "contacts[%zu]: %s on %s: two planes do not touch in a point", index,
                         a->id, b->id);
    for (int which = 0; which < 2; which++) {
        enum percuss_status status =
            place_side(geometry, contact, index, which, 0.1 * smallest, fault);
        if (status)
            return status;
    }
    double curvature[2];
    site_relative_curvature(&geometry->sides[index][0].site, &geometry->poses[contact->a],
                            &geometry->sides[index][1].site, &geometry->poses[contact->b],
                            contact->normal, curvature);
    if (!(curvature[0] > HERTZ_LINE_RATIO * curvature[1]))
        return fault_set(
            fault, PERCUSS_UNSUPPORTED_GEOMETRY,
            "contacts[%zu]: %s on %s touch in a %s there (relative curvatures %.3g and "
            "%.3g 1/m): only a point contact of two smooth surfaces is supported",
            index, a->id, b->id, curvature[1] > 0.0 ? "line" : "face", 2.0 * curvature[0],
            2.0 * curvature[1]);
    geometry->hertz[index] = hertz_contact_make(hertz_effective_modulus(&a->material, &b->material),
                                                curvature[0], curvature[1]);
    return PERCUSS_OK;
}

static void find_rates(struct geometry *geometry, const struct solve_request *request, size_t index)
{
    const struct solve_contact *contact = &request->contacts[index];
    double a[3];
    double b[3];
    point_velocity(&request->bodies[contact->a], contact->point, a);
    point_velocity(&request->bodies[contact->b], contact->point, b);
    sub3(a, b, a);
    geometry->gap_rate[index] = dot3(contact->normal, a);
    add_scaled3(-geometry->gap_rate[index], contact->normal, a);
    memcpy(geometry->sliding[index], a, sizeof a);
}

/* w_i^T M^-1 w_j from the bodies that both contacts share. */
static void find_service_w(struct geometry *geometry)
{
    size_t n = geometry->contact_count;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            double sum = 0.0;
            for (int p = 0; p < 2; p++) {
                for (int q = 0; q < 2; q++) {
                    const struct contact_side *a = &geometry->sides[i][p];
                    const struct contact_side *b = &geometry->sides[j][q];
                    if (a->body == b->body)
                        sum += rigid_inverse_mass(geometry->bodies[a->body], a->site.point,
                                                  a->direction, b->site.point, b->direction);
                }
            }
            geometry->service_w[i * n + j] = sum;
        }
    }
}

static enum percuss_status choose_w(struct geometry *geometry, const struct solve_request *request,
                                    struct arena *arena, struct fault *fault)
{
    size_t n = geometry->contact_count;
    find_service_w(geometry);
    geometry->from_client = request->delassus != NULL;
    memcpy(geometry->w, request->delassus ? request->delassus : geometry->service_w,
           n * n * sizeof *geometry->w);
    for (size_t i = 0; i < n; i++) {
        if (geometry->w[i * n + i] >= MIN_INVERSE_MASS &&
            geometry->w[i * n + i] <= 1.0 / MIN_INVERSE_MASS)
            continue;
        if (geometry->from_client)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "delassus[%zu]: %g: the diagonal must be between %g and %g 1/kg",
                             i * n + i, geometry->w[i * n + i], MIN_INVERSE_MASS,
                             1.0 / MIN_INVERSE_MASS);
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contacts[%zu]: neither %s nor %s can move rigidly there: at least one "
                         "partner must (or send the simulator's delassus)",
                         i, geometry->bodies[geometry->sides[i][0].body]->id,
                         geometry->bodies[geometry->sides[i][1].body]->id);
    }
    if (n == 1)
        return PERCUSS_OK;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < i; j++) {
            double scale = sqrt(geometry->w[i * (n + 1)]) * sqrt(geometry->w[j * (n + 1)]);
            double a = geometry->w[i * n + j];
            double b = geometry->w[j * n + i];
            if (!(fabs(a - b) <= 1e-9 * scale))
                return fault_set(fault, PERCUSS_BAD_REQUEST,
                                 "delassus[%zu] and [%zu]: %g and %g: the matrix must be symmetric",
                                 i * n + j, j * n + i, a, b);
        }
    double *scratch = arena_take(arena, n * (2 * n + 1), sizeof *scratch);
    if (!scratch)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    double ratio = linear_pseudo_inverse(n, geometry->w, 1e-12, scratch, scratch + n * n);
    if (!(ratio >= -1e-9))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "delassus: smallest eigenvalue is %g of the largest: the matrix must be "
                         "positive semidefinite",
                         ratio);
    return PERCUSS_OK;
}

/* 0 <= W P + gap rate, complementary to P >= 0: Eq. (4) for one contact. */
static enum percuss_status find_compression(struct geometry *geometry, struct fault *fault)
{
    size_t n = geometry->contact_count;
    if (n == 1) {
        geometry->impulse_compression[0] = fmax(0.0, -geometry->gap_rate[0] / geometry->w[0]);
        return PERCUSS_OK;
    }
    if (!lcp_solve(n, geometry->w, geometry->gap_rate, geometry->impulse_compression))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "delassus: no impulses satisfy 0 <= W P + gap rate with P >= 0: check the "
                         "matrix");
    return PERCUSS_OK;
}

static enum percuss_status check_approach(const struct geometry *geometry, struct fault *fault)
{
    double fastest = 0.0;
    bool approaches = false;
    for (size_t i = 0; i < geometry->contact_count; i++) {
        fastest = fmax(fastest, fabs(geometry->gap_rate[i]));
        approaches = approaches || geometry->gap_rate[i] < 0.0;
    }
    if (!(fastest <= MAX_SPEED))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bodies[].velocity: a gap rate of %g m/s: at most %g m/s is allowed",
                         fastest, MAX_SPEED);
    if (!approaches)
        return fault_set(fault, PERCUSS_NOT_APPROACHING,
                         "contacts[0]: gap rate n.(v_a - v_b) = %+g m/s: at least one contact must "
                         "approach (gap rate < 0; the normal points from b to a)",
                         geometry->gap_rate[0]);
    return PERCUSS_OK;
}

static bool allocate(struct geometry *geometry, struct arena *arena)
{
    size_t n = geometry->contact_count;
    geometry->sides = arena_take(arena, n, sizeof *geometry->sides);
    geometry->hertz = arena_take(arena, n, sizeof *geometry->hertz);
    geometry->gap_rate = arena_take(arena, n, sizeof(double));
    geometry->sliding = arena_take(arena, n, sizeof *geometry->sliding);
    geometry->service_w = arena_take(arena, n * n, sizeof(double));
    geometry->w = arena_take(arena, n * n, sizeof(double));
    geometry->impulse_compression = arena_take(arena, n, sizeof(double));
    return geometry->sides && geometry->hertz && geometry->gap_rate && geometry->sliding &&
           geometry->service_w && geometry->w && geometry->impulse_compression;
}

enum percuss_status geometry_find_rates(struct geometry *geometry,
                                        const struct solve_request *request, struct fault *fault)
{
    for (size_t i = 0; i < request->contact_count; i++)
        find_rates(geometry, request, i);
    enum percuss_status status = check_approach(geometry, fault);
    return status ? status : find_compression(geometry, fault);
}

enum percuss_status geometry_find(struct geometry *geometry, const struct body_set *catalogue,
                                  const struct solve_request *request, struct arena *arena,
                                  struct fault *fault)
{
    geometry->body_count = request->body_count;
    geometry->contact_count = request->contact_count;
    if (!allocate(geometry, arena))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = find_bodies(geometry, catalogue, request, arena, fault);
    for (size_t i = 0; !status && i < request->contact_count; i++)
        status = place_contact(geometry, request, i, fault);
    if (!status && !roll_choose(geometry, request, arena))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (!status)
        status = choose_w(geometry, request, arena, fault);
    if (!status)
        status = geometry_find_rates(geometry, request, fault);
    return status;
}

const struct site_load *geometry_load(const struct geometry *geometry, size_t contact, size_t body,
                                      enum mode_family family)
{
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &geometry->sides[contact][which];
        if (side->body == body && side->load.acts[family])
            return &side->load;
    }
    return NULL;
}
