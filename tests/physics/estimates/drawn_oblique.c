/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn.h"

/* The coefficients are the catalogue's, without deviations: so the errors of the tangential
 * impulses that answers state are those of their solutions and of the normal ones' models. Every
 * body has a material of its own name, each pair a coefficient. */
static void set_coefficients(struct lab *lab, uint64_t *r)
{
    static struct friction_pair pairs[PERCUSS_MAX_CONTACTS * PERCUSS_MAX_CONTACTS];
    size_t count = 0, bodies = lab->set.count;
    double usual = scene_log(r, 0.02, 1.5);
    for (size_t b = 0; b < bodies; b++)
        snprintf(lab->bodies[b].material.name, sizeof lab->bodies[b].material.name, "m%02zu", b);
    for (size_t a = 0; a < bodies; a++)
        for (size_t b = a + 1; b < bodies; b++) {
            struct friction_pair *pair = &pairs[count++];
            *pair = (struct friction_pair){.coefficient =
                                               scene_pick(r, 2) ? usual : scene_log(r, 0.02, 1.5)};
            snprintf(pair->between[0], sizeof pair->between[0], "m%02zu", a);
            snprintf(pair->between[1], sizeof pair->between[1], "m%02zu", b);
        }
    lab->set.friction = pairs;
    lab->set.friction_count = count;
}

/* A third of the scenes are of metals some of which yield. */
static void set_yields(struct lab *lab, uint64_t *r)
{
    if (scene_pick(r, 3))
        return;
    for (size_t b = 0; b < lab->set.count; b++)
        if (scene_pick(r, 3))
            lab->bodies[b].material.yield =
                lab->bodies[b].material.young * scene_log(r, 1e-3, 1e-2);
}

/* Speeds along the surface up to five times the approach, and spins of about as much. */
static void throw(uint64_t * r, struct solve_body *body, double radius, double approach)
{
    double slip = approach * (scene_pick(r, 6) ? scene_log(r, 0.02, 5.0) : 0.0);
    double about = random_between(r, 0.0, 2.0 * M_PI);
    body->velocity[0] += slip * cos(about);
    body->velocity[1] += slip * sin(about);
    for (int i = 0; scene_pick(r, 2) && i < 3; i++)
        body->angular_velocity[i] = random_between(r, -1.0, 1.0) * approach / radius;
}

/* A ball on another, a wall, a beam's side. */
static struct solve_request draw_ball(struct lab *lab, uint64_t *r, int kind, double approach)
{
    double radius = scene_log(r, 0.002, 0.02);
    struct spot under = wall_spot("under");
    lab_add(lab, "ball", make_sphere(scene_material(r), radius));
    if (kind == 0) {
        lab_add(lab, "under", make_body(&half_space_kind, scene_material(r)));
    } else if (kind == 1) {
        double other = radius * scene_log(r, 0.3, 3.0);
        lab_add(lab, "under", make_sphere(scene_material(r), other));
        under = (struct spot){"under", {0.0, 0.0, other}, {0.0, 0.0, 1.0}, 0.0};
    } else {
        const struct body *beam = scene_beam(lab, r, "under");
        radius = beam->radius * scene_log(r, 0.3, 2.0);
        lab_add(lab, "ball", make_sphere(scene_material(r), radius));
        under = side_spot("under", scene_place(r, beam->length), beam->radius, 0.0);
    }
    struct solve_request request = strike(sphere_spot("ball", radius), under, approach);
    throw(r, &request.bodies[0], radius, approach);
    return request;
}

/* A bar with round ends falls askew on a wall, or on a big ball. */
static struct solve_request draw_bar(struct lab *lab, uint64_t *r, double approach)
{
    double radius = scene_log(r, 0.002, 0.01), length = radius * scene_log(r, 20.0, 120.0);
    double angle = random_between(r, 0.0, 1.4);
    struct body bar = make_bar(&beam_kind, scene_material(r), radius, length);
    bar.tip_radius = radius;
    lab_add(lab, "bar", bar);
    lab_add(lab, "under", make_body(&half_space_kind, scene_material(r)));
    struct spot spot = {
        "bar", {0.5 * length - radius, 0.0, 0.0}, {cos(angle), 0.0, sin(angle)}, 0.0};
    add_scaled3(radius, spot.outward, spot.point);
    struct solve_request request = strike(spot, wall_spot("under"), approach);
    throw(r, &request.bodies[0], length, approach);
    return request;
}

void scene_draw_oblique(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    static const char *const kinds[] = {"ball on a wall",      "ball on a ball",  "ball on a beam",
                                        "bar askew on a wall", "group on a beam", "row"};
    int kind = scene_pick(r, (int)COUNT(kinds));
    double approach = scene_log(r, 0.03, 2.0);
    if (kind == 4)
        scene_draw_group(lab, r, scene);
    else if (kind == 5)
        scene_draw_row(lab, r, scene);
    else
        scene->request = kind == 3 ? draw_bar(lab, r, approach) : draw_ball(lab, r, kind, approach);
    /* of a group all are thrown */
    for (size_t b = 0; kind > 3 && b < scene->request.body_count; b++) {
        const struct body *body = body_set_find(&lab->set, scene->request.bodies[b].id);
        if (body->kind == &sphere_kind)
            throw(r, &scene->request.bodies[b], body->radius, approach);
    }
    set_coefficients(lab, r);
    set_yields(lab, r);
    scene_say(scene, "%s%s, approach %.4g m/s, mu %.3g", scene->text[0] ? "; " : "", kinds[kind],
              approach, lab->set.friction[0].coefficient);
}

void scene_draw_rubbed(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    scene_draw_lossy(lab, r, scene);
    struct solve_body *ball = &scene->request.bodies[0];
    throw(r, ball, body_set_find(&lab->set, ball->id)->radius, norm3(ball->velocity));
    set_coefficients(lab, r);
    scene_say(scene, ", mu %.3g", lab->set.friction[0].coefficient);
}
