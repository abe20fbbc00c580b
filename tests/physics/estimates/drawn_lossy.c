/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn.h"

/* From rubber to hard plastics, by a loss factor or a series of times around an impact's. */
static struct body draw_loss(uint64_t *r, struct body body)
{
    body.material = (struct material){"plastic", scene_log(r, 3e6, 6e9), 0.0, 0.0, INFINITY, 0.0};
    body.material.poisson = random_between(r, 0.3, 0.49);
    body.material.density = scene_log(r, 900.0, 2000.0);
    if (scene_pick(r, 2)) {
        body.loss_factor = scene_log(r, 0.003, 1.5);
        return body;
    }
    double left = random_between(r, 0.05, 0.95);
    for (int i = 1 + scene_pick(r, RELAXATION_TERMS); i > 0; i--) {
        double share = i > 1 ? left * random_between(r, 0.0, 1.0) : left;
        relaxation_add(&body.relaxation, share, scene_log(r, 1e-6, 1.0));
        left -= share;
    }
    body.loss_factor = NAN;
    return body;
}

static bool is_lossy(const struct body *body)
{
    return body->relaxation.count > 0 || body->loss_factor > 0.0;
}

/* As a catalogue does, but for materials that would damp too much. */
static struct body damp(struct body body)
{
    body.damping_peak = relaxation_peak_loss(&body.relaxation, 0.0);
    if (body.damping_peak >= 1.9)
        body.damping_peak = 0.0;
    body.damping = 0.5 * (body.relaxation.count > 0 ? body.damping_peak : body.loss_factor);
    return body;
}

static void say(struct scene_drawn *scene, const char *what, const struct body *body)
{
    scene_say(scene, "%s of E %.3g Pa", what, body->material.young);
    if (body->relaxation.count > 0)
        scene_say(scene, ", %zu terms down to %.2g of it", body->relaxation.count,
                  relaxation_storage(&body->relaxation, 0.0));
    else if (is_lossy(body))
        scene_say(scene, ", loss factor %.3g", body->loss_factor);
}

/* At least one of the two is lossy. */
void scene_draw_lossy(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    int kind = scene_pick(r, 3), which = scene_pick(r, 3);
    double speed = scene_log(r, 0.03, 3.0), radius = scene_log(r, 0.003, 0.03);
    struct body struck =
        kind == 0 ? make_body(&half_space_kind, scene_material(r))
        : kind == 1
            ? make_bar(&rod_kind, scene_material(r), radius, radius * scene_log(r, 8.0, 100.0))
            : make_bar(&beam_kind, scene_material(r), radius, radius * scene_log(r, 20.0, 100.0));
    double size = radius * scene_log(r, 0.3, 3.0);
    struct body ball = make_sphere(scene_material(r), size);
    if (which != 1)
        struck = draw_loss(r, struck);
    if (which != 0)
        ball = draw_loss(r, ball);
    if (kind != 0 && is_lossy(&struck))
        struck = damp(struck);
    const struct body *under = lab_add(lab, "struck", struck);
    const struct body *over = lab_add(lab, "ball", ball);
    struct spot at = kind == 0   ? wall_spot("struck")
                     : kind == 1 ? end_spot("struck", under->length)
                                 : side_spot("struck", scene_place(r, under->length), radius, 0.0);
    scene->request = strike(sphere_spot("ball", size), at, speed);
    scene_say(scene, "%.4g m/s, sphere R %.4g mm", speed, 1e3 * size);
    say(scene, "", over);
    scene_say(scene, " on a %s r %.4g mm L %.4g m", under->kind->name, 1e3 * under->radius,
              under->length);
    say(scene, "", under);
}

/* A ball that may be lossy. */
static const struct body *add_ball(struct lab *lab, uint64_t *r, struct scene_drawn *scene,
                                   const double at[3], double radius)
{
    struct solve_request *request = &scene->request;
    struct solve_body *body = &request->bodies[request->body_count++];
    struct body ball = make_sphere(scene_material(r), radius);
    *body = (struct solve_body){.orientation = {1.0, 0.0, 0.0, 0.0}};
    snprintf(body->id, sizeof body->id, "s%zu", request->body_count);
    memcpy(body->position, at, sizeof body->position);
    return lab_add(lab, body->id, scene_pick(r, 3) ? draw_loss(r, ball) : ball);
}

static void add_contact(struct solve_request *request, unsigned a, unsigned b,
                        const double point[3], double gap)
{
    struct solve_contact *contact = &request->contacts[request->contact_count++];
    *contact = (struct solve_contact){.a = a, .b = b, .normal = {0.0, 0.0, 1.0}, .gap = gap};
    memcpy(contact->point, point, sizeof contact->point);
}

/* The uppermost comes down on the others. */
static void draw_row(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    struct solve_request *request = &scene->request;
    unsigned count = 3 + (unsigned)scene_pick(r, 3);
    double usual = scene_log(r, 0.003, 0.03), z = 0.0;
    bool gaps = scene_pick(r, 2);
    for (unsigned i = 0; i < count; i++) {
        double radius = usual * scene_log(r, 0.5, 2.0);
        double gap = gaps && i > 0 ? scene_log(r, 1e-8, 1e-4) : 0.0;
        z -= gap;
        say(scene, i > 0 ? " then" : "row:",
            add_ball(lab, r, scene, (double[]){0.0, 0.0, z - radius}, radius));
        if (i > 0)
            add_contact(request, i - 1, i, (double[]){0.0, 0.0, z + 0.5 * gap}, gap);
        z -= 2.0 * radius;
    }
    request->bodies[0].velocity[2] = -scene_log(r, 0.03, 3.0);
}

/* Side by side on a beam. */
static void draw_beam(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    struct solve_request *request = &scene->request;
    unsigned count = 2 + (unsigned)scene_pick(r, 3);
    double radius = scene_log(r, 0.003, 0.03), length = radius * scene_log(r, 20.0, 100.0);
    struct body beam = make_bar(&beam_kind, scene_material(r), radius, length);
    const struct body *under =
        lab_add(lab, "beam", scene_pick(r, 2) ? damp(draw_loss(r, beam)) : beam);
    request->bodies[0] = (struct solve_body){.id = "beam", .orientation = {1.0, 0.0, 0.0, 0.0}};
    request->body_count = 1;
    say(scene, "beam", under);
    double speed = scene_log(r, 0.03, 3.0);
    for (unsigned i = 0; i < count; i++) {
        double x = under->length *
                   ((0.5 + (double)i + random_between(r, -0.4, 0.4)) / (double)count - 0.5);
        double ball = radius * scene_log(r, 0.3, 3.0);
        double gap = scene_pick(r, 2) ? 0.0 : scene_log(r, 1e-8, 1e-4);
        say(scene, ", ball",
            add_ball(lab, r, scene, (double[]){x, 0.0, under->radius + ball + gap}, ball));
        add_contact(request, i + 1, 0, (double[]){x, 0.0, under->radius}, gap);
        request->bodies[i + 1].velocity[2] = -speed * random_between(r, i > 0 ? -0.1 : 0.5, 1.0);
    }
}

void scene_draw_lossy_group(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    if (scene_pick(r, 2))
        draw_row(lab, r, scene);
    else
        draw_beam(lab, r, scene);
}
