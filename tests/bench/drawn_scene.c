/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "bench/drawn_scene.h"

double log_between(uint64_t *r, double low, double high)
{
    return exp(random_between(r, log(low), log(high)));
}

int pick(uint64_t *r, int count)
{
    return (int)random_between(r, 0.0, count);
}

static struct material draw_material(uint64_t *r)
{
    static const struct material list[] = {{"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0},
                                           {"aluminium", 70e9, 0.33, 2700.0, 205e6, 0.0},
                                           {"glass", 48e9, 0.20, 2800.0, INFINITY, 0.0},
                                           {"rubber", 5e6, 0.49, 1100.0, INFINITY, 0.0},
                                           {"lead", 16e9, 0.44, 11340.0, INFINITY, 0.0},
                                           {"cork", 30e6, 0.0, 200.0, INFINITY, 0.0},
                                           {"carbide", 600e9, 0.22, 15600.0, INFINITY, 0.0}};
    return list[pick(r, pick(r, 2) ? 2 : (int)COUNT(list))];
}

static double draw_damping(uint64_t *r)
{
    int kind = pick(r, 4);
    return kind < 2 ? 0.0 : kind == 2 ? log_between(r, 1e-4, 0.1) : random_between(r, 0.0, 0.99);
}

static void draw_supports(uint64_t *r, struct body *bar)
{
    if (pick(r, 2))
        return;
    for (int end = 0; end < 2; end++)
        bar->supports[end] = (enum support)pick(r, 3);
}

/* A rod hit on its end at +length/2: free there, free or fixed at the other. */
static struct spot draw_rod(struct lab *lab, uint64_t *r, const char *id, double radius,
                            bool tipped)
{
    double length = radius * log_between(r, 5.0, 300.0);
    struct body rod = make_bar(&rod_kind, draw_material(r), radius, length);
    rod.tip_radius = tipped ? radius * log_between(r, 1.01, 10.0) : INFINITY;
    rod.damping = draw_damping(r);
    rod.lateral_inertia = pick(r, 4) == 0;
    rod.supports[0] = pick(r, 3) ? SUPPORT_FREE : SUPPORT_CLAMPED;
    lab_add(lab, id, rod);
    return end_spot(id, length);
}

/* A beam hit on its side, now and then on its end. */
static struct spot draw_beam(struct lab *lab, uint64_t *r, const char *id, double radius)
{
    double length = radius * log_between(r, 8.0, 300.0);
    struct body beam = make_bar(&beam_kind, draw_material(r), radius, length);
    bool round = pick(r, 3) > 0;
    if (!round) {
        beam.radius = 0.0;
        beam.width = radius * random_between(r, 0.5, 3.0);
        beam.height = 2.0 * radius;
    }
    beam.theory = pick(r, 3) ? THEORY_TIMOSHENKO : THEORY_EULER_BERNOULLI;
    beam.damping = draw_damping(r);
    beam.modes = pick(r, 8) ? 0 : 1 + (unsigned)pick(r, 60);
    draw_supports(r, &beam);
    lab_add(lab, id, beam);
    if (pick(r, 8) == 0 && beam.supports[1] == SUPPORT_FREE)
        return end_spot(id, length);
    static const double sites[] = {0.0, 0.0, 0.25, -0.19, 0.31};
    double x = length * (pick(r, 2) ? random_between(r, -0.45, 0.45) : sites[pick(r, 5)]);
    double about = round && pick(r, 3) == 0 ? random_between(r, 0.0, 6.28) : 0.0;
    struct spot spot = side_spot(id, x, radius, about);
    spot.roll = random_between(r, 0.0, 3.14);
    return spot;
}

static struct spot draw_compact(struct lab *lab, uint64_t *r, const char *id, double radius)
{
    int kind = pick(r, 4);
    struct body body = make_body(&half_space_kind, draw_material(r));
    struct spot spot = wall_spot(id);
    if (kind == 0) {
        body = make_sphere(draw_material(r), radius);
        spot = sphere_spot(id, radius);
    } else if (kind == 1) {
        body = make_bar(&cylinder_kind, draw_material(r), radius, 3.0 * radius);
        spot = side_spot(id, radius * random_between(r, -1.0, 1.0), radius, 0.0);
        spot.roll = random_between(r, 0.0, 3.14);
    } else if (kind == 2) {
        body = make_body(&block_kind, draw_material(r));
        for (int i = 0; i < 3; i++)
            body.size[i] = radius * random_between(r, 1.0, 4.0);
        spot = (struct spot){id, {0.0, 0.0, 0.5 * body.size[2]}, {0.0, 0.0, 1.0}, 0.0};
    }
    lab_add(lab, id, body);
    return spot;
}

static void draw_motion(uint64_t *r, struct drawn *drawn, double speed, double radius)
{
    struct solve_contact *contact = drawn->request.contacts;
    int kind = pick(r, 6);
    if (kind == 0)
        for (int i = 0; i < 3; i++)
            drawn->request.bodies[0].angular_velocity[i] =
                random_between(r, -0.3, 0.3) * speed / radius;
    if (kind == 1)
        contact->gap = radius * random_between(r, -1e-3, 3e-3);
    if (kind == 2 || kind == 3) {
        double sign = pick(r, 3) ? -1.0 : 1.0;
        contact->gap_acceleration = kind == 2 ? sign * 9.81 : sign * log_between(r, 1e-3, 1e6);
        drawn->passive = false;
    }
}

/* One contact: something round comes down on anything. */
static void draw_pair(struct lab *lab, uint64_t *r, struct drawn *drawn)
{
    double speed = pick(r, 3) ? log_between(r, 0.01, 1.0) : log_between(r, 1e-9, 100.0);
    double radius = log_between(r, 1e-3, 0.1);
    double other = radius * log_between(r, 0.1, 10.0);
    int striker = pick(r, 10);
    int target = pick(r, 10);
    struct spot a;
    struct spot b;
    if (striker < 7) {
        lab_add(lab, "a", make_sphere(draw_material(r), radius));
        a = sphere_spot("a", radius);
    } else
        a = striker < 9 ? draw_rod(lab, r, "a", radius, true) : draw_beam(lab, r, "a", radius);
    if (target < 5)
        b = draw_beam(lab, r, "b", other);
    else if (target < 8)
        b = draw_rod(lab, r, "b", other, pick(r, 2));
    else
        b = draw_compact(lab, r, "b", other);
    drawn->request = strike(a, b, speed);
    drawn->passive = true;
    draw_motion(r, drawn, speed, fmin(radius, other));
    snprintf(drawn->text, sizeof drawn->text, "%s R=%.3g on %s R=%.3g L=%.3g zeta=%.2g v=%.3g",
             lab->bodies[0].kind->name, radius, lab->bodies[1].kind->name, other,
             lab->bodies[1].length, lab->bodies[1].damping, speed);
}

/* Spheres in a column, the uppermost comes down; small gaps between some. */
static void draw_column(struct lab *lab, uint64_t *r, struct drawn *drawn)
{
    struct solve_request *request = &drawn->request;
    static const char ids[][2] = {"a", "b", "c", "d", "e"};
    size_t count = 3 + (size_t)pick(r, 3);
    double z = 0.0;
    memset(request, 0, sizeof *request);
    for (size_t i = 0; i < count; i++) {
        double radius = log_between(r, 0.005, 0.02);
        lab_add(lab, ids[i], make_sphere(draw_material(r), radius));
        struct solve_body *body = &request->bodies[request->body_count++];
        *body = (struct solve_body){.orientation = {1.0, 0.0, 0.0, 0.0}};
        snprintf(body->id, sizeof body->id, "%s", ids[i]);
        body->velocity[2] = i == 0 ? -random_between(r, 0.01, 2.0) : 0.0;
        if (i) {
            struct solve_contact *contact = &request->contacts[request->contact_count++];
            *contact = (struct solve_contact){.a = (unsigned)i - 1,
                                              .b = (unsigned)i,
                                              .point = {0.0, 0.0, z},
                                              .normal = {0, 0, 1.0}};
            contact->gap = pick(r, 3) ? 0.0 : log_between(r, 1e-9, 1e-5);
        }
        body->position[2] = z - radius;
        z -= 2.0 * radius;
    }
    snprintf(drawn->text, sizeof drawn->text, "column of %zu spheres", count);
}

/* Two to four spheres at a beam, on one side of it; the beam may move instead. */
static void draw_landing(struct lab *lab, uint64_t *r, struct drawn *drawn)
{
    struct solve_request *request = &drawn->request;
    static const char ids[][2] = {"a", "c", "d", "e"};
    size_t count = 2 + (size_t)pick(r, 3);
    double radius = log_between(r, 0.003, 0.02);
    double length = radius * log_between(r, 20.0, 150.0);
    struct body beam = make_bar(&beam_kind, draw_material(r), radius, length);
    beam.damping = draw_damping(r);
    draw_supports(r, &beam);
    memset(request, 0, sizeof *request);
    for (size_t i = 0; i < count; i++) {
        double ball = log_between(r, 0.005, 0.02);
        double x = length * (-0.4 + 0.8 * (double)i / (double)(count - 1));
        lab_add(lab, ids[i], make_sphere(draw_material(r), ball));
        struct solve_body *body = &request->bodies[request->body_count++];
        *body = (struct solve_body){.position = {x, 0.0, radius + ball},
                                    .orientation = {1.0, 0.0, 0.0, 0.0},
                                    .velocity = {0.0, 0.0, random_between(r, -1.0, 0.2)}};
        snprintf(body->id, sizeof body->id, "%s", ids[i]);
        request->contacts[request->contact_count++] =
            (struct solve_contact){.a = (unsigned)i,
                                   .b = (unsigned)count,
                                   .point = {x, 0.0, radius},
                                   .normal = {0.0, 0.0, 1.0},
                                   .gap = pick(r, 2) ? 0.0 : log_between(r, 1e-8, 1e-4),
                                   .gap_acceleration = pick(r, 3) ? 0.0 : -9.81};
    }
    lab_add(lab, "b", beam);
    struct solve_body *body = &request->bodies[request->body_count++];
    *body = (struct solve_body){.id = "b", .orientation = {1.0, 0.0, 0.0, 0.0}};
    snprintf(drawn->text, sizeof drawn->text, "%zu spheres on a beam R=%.3g L=%.3g zeta=%.2g",
             count, radius, length, beam.damping);
}

void draw_scene(struct lab *lab, uint64_t number, struct drawn *drawn)
{
    static const double tolerances[] = {1e-2, 1e-3, 1e-3, 1e-4, 1e-6, 1e-8};
    uint64_t r = 0x9e3779b97f4a7c15u * (number + 1);
    for (int i = 0; i < 8; i++)
        random_between(&r, 0.0, 1.0);
    lab->set.count = 0;
    memset(drawn, 0, sizeof *drawn);
    int kind = pick(&r, 8);
    if (kind == 0)
        draw_column(lab, &r, drawn);
    else if (kind == 1)
        draw_landing(lab, &r, drawn);
    else
        draw_pair(lab, &r, drawn);
    drawn->request.options.tolerance = tolerances[pick(&r, (int)COUNT(tolerances))];
    size_t used = strlen(drawn->text);
    snprintf(drawn->text + used, sizeof drawn->text - used, " gap=%.2g acc=%.2g tol=%.0e",
             drawn->request.contacts[0].gap, drawn->request.contacts[0].gap_acceleration,
             drawn->request.options.tolerance);
}
