/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/support.h"

struct lab *lab_create(void)
{
    struct lab *lab = calloc(1, sizeof *lab);
    assert_non_null(lab);
    lab->set.bodies = lab->bodies;
    lab->set.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    lab->means.catalogue = &lab->set;
    lab->workspace = solve_workspace_create();
    assert_non_null(lab->workspace);
    return lab;
}

void lab_free(struct lab *lab)
{
    solve_workspace_free(lab->workspace);
    free(lab);
}

const struct body *lab_add(struct lab *lab, const char *id, struct body body)
{
    static unsigned revisions;
    struct fault fault = {0};
    size_t at = 0;
    snprintf(body.id, sizeof body.id, "%s", id);
    if (body_complete(&body, &fault))
        fail_msg("%s: %s", id, fault.text);
    while (at < lab->set.count && strcmp(lab->bodies[at].id, id) != 0)
        at++;
    assert_true(at < COUNT(lab->bodies));
    snprintf(lab->set.revision, sizeof lab->set.revision, "lab-%u", ++revisions);
    lab->bodies[at] = body;
    lab->set.count = at == lab->set.count ? at + 1 : lab->set.count;
    return &lab->bodies[at];
}

struct body make_sphere(struct material material, double radius)
{
    struct body body = make_body(&sphere_kind, material);
    body.radius = radius;
    return body;
}

struct body make_bar(const struct body_kind *kind, struct material material, double radius,
                     double length)
{
    struct body body = make_body(kind, material);
    body.radius = radius;
    body.length = length;
    return body;
}

struct body make_supported(struct body bar, enum support left, enum support right)
{
    bar.supports[0] = left;
    bar.supports[1] = right;
    return bar;
}

struct body make_cowper(struct body beam)
{
    beam.shear_rule = SHEAR_COWPER;
    return beam;
}

struct spot side_spot(const char *id, double x, double radius, double about)
{
    return (struct spot){
        id, {x, radius * sin(about), radius * cos(about)}, {0.0, sin(about), cos(about)}, 0.0};
}

struct body rigid_wall(void)
{
    return make_body(&half_space_kind,
                     (struct material){"rigid", 1e13, -1.0 + 1e-12, 1000.0, INFINITY, 0.0});
}

static void quaternion_product(const double p[4], const double q[4], double r[4])
{
    double w = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    double x = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    double y = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    double z = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
    double norm = sqrt(w * w + x * x + y * y + z * z);
    r[0] = w / norm;
    r[1] = x / norm;
    r[2] = y / norm;
    r[3] = z / norm;
}

void aim(const double from[3], const double to[3], double roll, double q[4])
{
    double axis[3];
    cross3(from, to, axis);
    double swing[4] = {1.0 + dot3(from, to), axis[0], axis[1], axis[2]};
    double spin[4] = {cos(0.5 * roll), sin(0.5 * roll) * to[0], sin(0.5 * roll) * to[1],
                      sin(0.5 * roll) * to[2]};
    if (swing[0] < 1e-9) { /* opposite: half a turn about any axis across */
        int k = fabs(from[0]) < 0.6 ? 0 : 1;
        double any[3] = {k == 0, k == 1, 0.0};
        cross3(from, any, axis);
        scale3(1.0 / norm3(axis), axis, axis);
        swing[0] = 0.0;
        memcpy(swing + 1, axis, sizeof axis);
    }
    quaternion_product(spin, swing, q);
}

void put(struct solve_body *body, const struct spot *spot, const double outward[3])
{
    double rotation[9];
    double arm[3];
    memset(body, 0, sizeof *body);
    snprintf(body->id, sizeof body->id, "%s", spot->id);
    aim(spot->outward, outward, spot->roll, body->orientation);
    rotation_matrix(body->orientation, rotation);
    rotate3(rotation, spot->point, arm);
    scale3(-1.0, arm, body->position);
}

struct solve_request strike(struct spot a, struct spot b, double speed)
{
    static const double up[3] = {0.0, 0.0, 1.0};
    static const double down[3] = {0.0, 0.0, -1.0};
    struct solve_request request = {.body_count = 2, .contact_count = 1};
    put(&request.bodies[0], &a, down);
    put(&request.bodies[1], &b, up);
    request.bodies[0].velocity[2] = -speed;
    request.contacts[0] = (struct solve_contact){.a = 0, .b = 1, .normal = {0.0, 0.0, 1.0}};
    return request;
}

void move_scene(struct solve_request *request, const double q[4], const double shift[3],
                const double velocity[3])
{
    double r[9];
    rotation_matrix(q, r);
    for (size_t b = 0; b < request->body_count; b++) {
        struct solve_body *body = &request->bodies[b];
        double old[4];
        rotate3(r, (double[]){body->position[0], body->position[1], body->position[2]},
                body->position);
        rotate3(r, (double[]){body->velocity[0], body->velocity[1], body->velocity[2]},
                body->velocity);
        rotate3(r,
                (double[]){body->angular_velocity[0], body->angular_velocity[1],
                           body->angular_velocity[2]},
                body->angular_velocity);
        add_scaled3(1.0, shift, body->position);
        add_scaled3(1.0, velocity, body->velocity);
        memcpy(old, body->orientation, sizeof old);
        quaternion_product(q, old, body->orientation);
    }
    for (size_t c = 0; c < request->contact_count; c++) {
        struct solve_contact *contact = &request->contacts[c];
        rotate3(r, (double[]){contact->point[0], contact->point[1], contact->point[2]},
                contact->point);
        rotate3(r, (double[]){contact->normal[0], contact->normal[1], contact->normal[2]},
                contact->normal);
        add_scaled3(1.0, shift, contact->point);
    }
}

void lab_solve(struct lab *lab, const struct solve_request *request, struct solve_result *result)
{
    if (solve(lab->workspace, &lab->means, request, result))
        fail_msg("%s: %s", status_name(result->status), result->fault.text);
}

double random_between(uint64_t *state, double low, double high)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    uint64_t bits = *state * 2685821657736338717u;
    return low + (high - low) * (double)(bits >> 11) * 0x1p-53;
}

void random_rotation(uint64_t *state, double q[4])
{
    double square;
    do {
        square = 0.0;
        for (int i = 0; i < 4; i++) {
            q[i] = random_between(state, -1.0, 1.0);
            square += q[i] * q[i];
        }
    } while (square > 1.0 || square < 0.01);
    for (int i = 0; i < 4; i++)
        q[i] /= sqrt(square);
}

double sphere_plane_stiffness(struct material a, struct material b, double radius)
{
    double flexibility =
        (1.0 - a.poisson * a.poisson) / a.young + (1.0 - b.poisson * b.poisson) / b.young;
    return 4.0 / 3.0 / flexibility * sqrt(radius);
}
