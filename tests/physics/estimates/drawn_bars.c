/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn.h"

static struct body_state *copy_state(const struct body_state *state)
{
    struct body_state *copy = state ? malloc(body_state_size(state)) : NULL;
    if (copy)
        memcpy(copy, state, body_state_size(state));
    return copy;
}

/* A rod with a round tip of either kind of ends, hit or hitting with it. */
static const struct body *tipped_rod(struct lab *lab, uint64_t *r, const char *id)
{
    double radius = scene_log(r, 0.003, 0.02);
    struct body rod =
        make_bar(&rod_kind, scene_material(r), radius, radius * scene_log(r, 8.0, 200.0));
    rod.tip_radius = radius * scene_log(r, 1.05, 4.0);
    rod.damping = scene_pick(r, 3) ? 0.0 : scene_log(r, 1e-4, 0.05);
    return lab_add(lab, id, rod);
}

/* What strikes a ringing body, or rings itself. */
static struct spot draw_striker(struct lab *lab, uint64_t *r, double size, bool flexible)
{
    if (flexible)
        return end_spot("a", tipped_rod(lab, r, "a")->length);
    double radius = size * scene_log(r, 0.5, 10.0);
    lab_add(lab, "a", make_sphere(scene_material(r), radius));
    return sphere_spot("a", radius);
}

/* The token is what a client has: of an answer at the default tolerance. */
bool scene_draw_ringing(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    static struct solve_result first;
    bool both = scene_pick(r, 4) == 0;
    const struct body *bar = scene_pick(r, 4) ? scene_beam(lab, r, "b") : tipped_rod(lab, r, "b");
    bool beam = bar->kind == &beam_kind;
    double size = bar->radius, length = bar->length;
    struct spot striker = draw_striker(lab, r, size, both);
    double speed = scene_log(r, 0.03, 1.0);
    double elapsed = scene_log(r, 1e-6, 1.0);
    struct spot spots[2];
    for (int blow = 0; blow < 2; blow++)
        spots[blow] =
            beam ? side_spot("b", scene_place(r, length), size, 0.0) : end_spot("b", length);
    if (scene_pick(r, 3) == 0)
        spots[1] = spots[0];
    struct solve_request blow = strike(striker, spots[0], speed);
    enum percuss_status status = solve(lab->workspace, &lab->means, &blow, &first);
    if (status != PERCUSS_OK && status != PERCUSS_TRUNCATED)
        return false;
    double second = speed * scene_log(r, 0.03, 3.0);
    scene->request = strike(striker, spots[1], second);
    for (size_t b = 0; b < 2; b++) {
        scene->states[b] = copy_state(first.bodies[b].state_after);
        scene->request.bodies[b].state = scene->states[b];
        scene->request.bodies[b].elapsed = elapsed;
    }
    scene_say(scene, "%s on a %s, %.4g m/s at %.4g m, after %.3g s %.4g m/s at %.4g m, zeta %.2g",
              both ? "tipped rod" : "sphere", beam ? "beam" : "tipped rod", speed,
              spots[0].point[0], elapsed, second, spots[1].point[0], bar->damping);
    return true;
}

/* Blows of one sphere on one bar: number % 4 + 2 of them, every other four undamped. */
void scene_draw_chain(struct lab *lab, uint64_t *r, uint64_t number, struct scene_drawn *scene)
{
    bool rod = scene_pick(r, 4) == 0;
    bool damped = number / 4 % 2;
    struct body bar = rod ? *tipped_rod(lab, r, "b") : *scene_beam(lab, r, "b");
    bar.damping = damped ? scene_log(r, 1e-4, 0.05) : 0.0;
    lab->set.count = 0;
    lab_add(lab, "b", bar);
    double radius = bar.radius * scene_log(r, 0.3, 5.0);
    lab_add(lab, "a", make_sphere(scene_material(r), radius));
    double speed = scene_log(r, 0.03, 1.0);
    struct spot striker = sphere_spot("a", radius);
    struct spot spot = rod ? end_spot("b", bar.length)
                           : side_spot("b", scene_place(r, bar.length), bar.radius, 0.0);
    size_t blows = 2 + number % 4;
    scene_say(scene,
              "%zu blows of a sphere R %.4g mm on a %s r %.4g mm L %.4g m, zeta %.2g:", blows,
              1e3 * radius, rod ? "rod" : "beam", 1e3 * bar.radius, bar.length, bar.damping);
    for (size_t i = 0; i < blows; i++) {
        struct solve_request *blow = i + 1 < blows ? &scene->earlier[i] : &scene->request;
        if (!rod && i && scene_pick(r, 2))
            spot = side_spot("b", scene_place(r, bar.length), bar.radius, 0.0);
        double v = speed * scene_log(r, 0.2, 2.0);
        *blow = strike(striker, spot, v);
        /* from the stated instant of the one before, which is over by then */
        blow->bodies[1].elapsed = i ? 0.05 + scene_log(r, 1e-5, 0.3) : 0.0;
        scene_say(scene, " %.3g m/s at %.4g after %.3g s;", v, spot.point[0],
                  blow->bodies[1].elapsed);
    }
    scene->earlier_count = blows - 1;
}

static const struct body *rectangular_bar(struct lab *lab, uint64_t *r, const char *id)
{
    struct body bar = make_bar(&beam_kind, scene_material(r), 0.0, 0.0);
    bar.height = scene_log(r, 0.002, 0.03);
    bar.width = bar.height * scene_log(r, 0.3, 10.0);
    bar.length = fmax(bar.height, bar.width) * scene_log(r, 6.0, 60.0);
    bar.theory = scene_pick(r, 4) ? THEORY_TIMOSHENKO : THEORY_EULER_BERNOULLI;
    bar.damping = scene_pick(r, 3) ? 0.0 : scene_log(r, 1e-4, 0.05);
    for (int end = 0; end < 2; end++)
        bar.supports[end] = scene_pick(r, 2) ? SUPPORT_FREE : (enum support)scene_pick(r, 3);
    return lab_add(lab, id, bar);
}

/* On one of the four long faces, off the middle line; now and then on the free end's face. */
static struct spot rectangular_spot(uint64_t *r, const struct body *bar, bool *end)
{
    double half[3] = {0.5 * bar->length, 0.5 * bar->width, 0.5 * bar->height};
    struct spot spot = {.id = bar->id};
    *end = bar->supports[1] == SUPPORT_FREE && scene_pick(r, 3) == 0;
    int face = *end ? 0 : 1 + scene_pick(r, 2);
    for (int i = 0; i < 3; i++)
        spot.point[i] = half[i] * random_between(r, -0.95, 0.95);
    if (!*end)
        spot.point[0] = scene_place(r, bar->length);
    double side = *end || scene_pick(r, 2) ? 1.0 : -1.0;
    spot.point[face] = side * half[face];
    spot.outward[face] = side;
    return spot;
}

void scene_draw_eccentric(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    const struct body *bar = rectangular_bar(lab, r, "bar");
    double ball = fmin(bar->height, bar->width) * scene_log(r, 0.3, 3.0);
    double speed = scene_log(r, 0.03, 1.0);
    bool end;
    struct spot at = rectangular_spot(r, bar, &end);
    lab_add(lab, "ball", make_sphere(scene_material(r), ball));
    scene->request = strike(sphere_spot("ball", ball), at, speed);
    scene_say(scene,
              "sphere R %.4g mm, %.4g m/s, on %s of %.4g x %.4g x %.4g mm at %.4g %.4g %.4g mm, "
              "ends %d %d",
              1e3 * ball, speed, end ? "the end face" : "a side", 1e3 * bar->length,
              1e3 * bar->width, 1e3 * bar->height, 1e3 * at.point[0], 1e3 * at.point[1],
              1e3 * at.point[2], (int)bar->supports[0], (int)bar->supports[1]);
}

/* Bars across each other or a tip on a bar. A round section may turn about its axis under the
 * contact: the reference is without. A rectangular one is struck on any of its faces. */
void scene_draw_rolled(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    bool round = scene_pick(r, 3) > 0;
    bool tip = !round || scene_pick(r, 2); /* a cylinder on a plane touches in a line */
    double speed = scene_log(r, 0.03, 1.0);
    double about[2] = {random_between(r, -M_PI, M_PI), random_between(r, -M_PI, M_PI)};
    const struct body *bar = round ? scene_beam(lab, r, "b") : rectangular_bar(lab, r, "b");
    double x = scene_place(r, bar->length);
    bool end = false;
    struct spot rectangular = round ? (struct spot){0} : rectangular_spot(r, bar, &end);
    const struct body *striker = tip ? tipped_rod(lab, r, "a") : scene_beam(lab, r, "a");
    if (!tip) /* one of the two must be able to move */
        striker = lab_add(lab, "a", make_supported(*striker, SUPPORT_FREE, SUPPORT_FREE));
    double y = tip ? 0.0 : scene_place(r, striker->length);
    /* never parallel: lines of contact are not available */
    double crossing = random_between(r, 0.3, M_PI - 0.3);
    for (int rolled = 0; rolled < 2; rolled++) {
        struct spot a = tip ? end_spot("a", striker->length)
                            : side_spot("a", y, striker->radius, rolled ? about[0] : 0.0);
        struct spot b =
            round ? side_spot("b", x, lab->bodies[0].radius, rolled ? about[1] : 0.0) : rectangular;
        a.roll = tip && rolled ? about[0] : crossing;
        struct solve_request request = strike(a, b, speed);
        *(rolled ? &scene->request : &scene->plain) = request;
    }
    scene_say(scene, "%s on %s, %.4g m/s, rolled by %.3g and %.3g", tip ? "a tipped rod" : "a beam",
              round ? "a round beam" : "a rectangular bar", speed, about[0], about[1]);
}
