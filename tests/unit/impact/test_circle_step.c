/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/circle_step.c and contact/circles.c: balls with spin on laws that
 * have a loss against the circles one by one, and where the loss vanishes against the cells of
 * contact/friction.c. */
#include "impact/circle_step.h"

#include <math.h>

#include "unit/impact/one_by_one.h"
#include "unit/impact/toy_scene.h"

static const double KAPPA = 2.0 / 3.0; /* an incompressible solid */

/* A solid sphere of unit mass at unit speed. */
static void make_ball(struct toy *toy, struct scene_friction *friction, double slip)
{
    toy_init(toy, 1);
    scene_set_frictions(&toy->scene, 1);
    toy->scene.friction = friction;
    toy->w[4] = toy->w[8] = 3.5;
    toy->gap_rate[0] = -1.0;
    toy->gap_rate[1] = slip;
}

static const struct wall RIGID = {0.0, 0.0, 0.0};

/* The circles' own steps leave 1e-4; between two of memory's parabola the restitution differs by
 * 0.0011 at most (test_memory_step.c), and the speed along the surface follows the normal force.
 * A force that is scaled by what the normal one has relaxed would be wrong by .02 to .5, an elastic
 * one by up to .35. */
static void balls_spin_by_their_circles(void **state)
{
    (void)state;
    static const struct relaxation of[] = {{1, {0.3}, {0.5}},
                                           {1, {0.5}, {3.0}},
                                           {1, {0.3}, {0.1}},
                                           {3, {0.2, 0.3, 0.3}, {0.1, 1.0, 8.0}}};
    static const double coefficient[] = {0.3, 1.0}, slip[] = {0.3, 1.0, 2.0};
    for (size_t i = 0; i < COUNT(of) * COUNT(coefficient) * COUNT(slip); i++) {
        const struct relaxation *relaxation = &of[i / (COUNT(coefficient) * COUNT(slip))];
        double mu = coefficient[i / COUNT(slip) % COUNT(coefficient)], v = slip[i % COUNT(slip)];
        struct scene_friction friction = {.coefficient = mu, .ratio = {KAPPA, 0.0, KAPPA}};
        const struct spin spin = {mu, KAPPA, v, 3.5};
        const struct rebound exact = one_by_one(relaxation, 0.0, &RIGID, &spin);
        struct toy toy;
        make_ball(&toy, &friction, v);
        toy.laws[0] = contact_law_viscoelastic(1.0, relaxation);
        struct impact_outcome fine = toy_run(&toy, 1e-7, 100.0), rough = toy_run(&toy, 1e-4, 100.0);
        print_message("share %.1f time %.1f mu %.1f slip %.1f: e %.4f, along %.5f, circles %.5f\n",
                      relaxation->share[0], relaxation->time[0], mu, v, fine.motion.gap_rate[0],
                      fine.motion.gap_rate[1], exact.along);
        measured("along", fine.motion.gap_rate[1], exact.along, 0.0013);
        measured("up", fine.motion.gap_rate[0], exact.up, 0.0013);
        /* as spheres without a loss (test_friction_step.c) */
        measured("rough", rough.motion.gap_rate[1], fine.motion.gap_rate[1], 7e-4 * mu / KAPPA);
        measured("closure", fine.energy.closure, 0.0, 1e-12);
        measured("turned", fine.motion.gap_rate[2], 0.0, 0.0);
        assert_true(fine.slid > 0.0 && fine.relaxed > 0.0);
        toy_free(&toy);
    }
}

/* Hunt and Crossley: springs are elastic, and limits follow the force. */
static void limits_follow_the_rate(void **state)
{
    (void)state;
    static const struct relaxation none = {0, {0.0}, {0.0}};
    static const double dissipation[] = {0.1, 0.5, 2.0}, slip[] = {0.3, 1.0, 2.0};
    for (size_t i = 0; i < COUNT(dissipation) * COUNT(slip); i++) {
        double c = dissipation[i / COUNT(slip)], v = slip[i % COUNT(slip)];
        struct scene_friction friction = {.coefficient = 0.3, .ratio = {KAPPA, 0.0, KAPPA}};
        const struct spin spin = {0.3, KAPPA, v, 3.5};
        const struct rebound exact = one_by_one(&none, c, &RIGID, &spin);
        struct toy toy;
        make_ball(&toy, &friction, v);
        toy.laws[0] = contact_law_dissipative(1.0, 1.5, c);
        struct impact_outcome fine = toy_run(&toy, 1e-7, 100.0), rough = toy_run(&toy, 1e-4, 100.0);
        print_message("dissipation %.1f slip %.1f: e %.4f, along %.5f, circles %.5f\n", c, v,
                      fine.motion.gap_rate[0], fine.motion.gap_rate[1], exact.along);
        measured("along", fine.motion.gap_rate[1], exact.along, 5e-4);
        measured("up", fine.motion.gap_rate[0], exact.up, 5e-4);
        measured("rough", rough.motion.gap_rate[1], fine.motion.gap_rate[1], 7e-4 * 0.3 / KAPPA);
        measured("closure", fine.energy.closure, 0.0, 1e-12);
        toy_free(&toy);
    }
}

/* A ball that hits a wall twice: what the first blow has left is there, along the surface, too.
 * Where circles forget it the speed is wrong by 0.0054. */
static void second_blows_find_what_was_left(void **state)
{
    (void)state;
    static const struct relaxation of = {3, {0.2, 0.3, 0.3}, {0.1, 1.0, 8.0}};
    static const double omega = 0.5, phi[] = {0.7, 0.0, 0.0};
    const struct wall wall = {omega, phi[0], 1.4 * M_PI / omega + 3.0};
    const struct spin spin = {1.0, KAPPA, 0.6, 3.5};
    const struct rebound exact = one_by_one(&of, 0.0, &wall, &spin);
    struct scene_friction friction = {.coefficient = 1.0, .ratio = {KAPPA, 0.0, KAPPA}};
    struct toy toy;
    make_ball(&toy, &friction, 0.6);
    toy_add(&toy, 0, 1, &omega, 0.0, phi);
    toy.laws[0] = contact_law_viscoelastic(1.0, &of);
    struct impact_outcome outcome = toy_run(&toy, 1e-7, 1e3);
    print_message("along %.5f, circles %.5f\n", outcome.motion.gap_rate[1], exact.along);
    assert_int_equal(outcome.tracks[0].count, 2);
    measured("along", outcome.motion.gap_rate[1], exact.along, 0.0013);
    toy_free(&toy);
}

/* A loss of 1e-9 is none. Ways that turn in the plane, elliptic contacts, and bodies that spin: the
 * cells, which follow a force's turn by its closed form, and the circles go to the same speeds with
 * the steps: 5e-4 apart at an accuracy of 1e-5, 4e-4 at 1e-7, 2.1e-4 here, where an elliptic
 * contact slides throughout; 3e-5 where it sticks at times. */
static void without_a_loss_they_are_the_cells(void **state)
{
    (void)state;
    static const struct relaxation slight = {1, {1e-9}, {1.0}};
    static const double ratio[][3] = {{0.8, 0.0, 0.8}, {0.8, 0.1, 0.6}};
    static const double slip[][2] = {{0.8, 0.5}, {0.2, -0.1}, {-1.5, 0.4}};
    for (size_t i = 0; i < 2 * 2 * COUNT(slip); i++) {
        struct scene_friction friction = {.coefficient = 0.3};
        double after[2][3];
        memcpy(friction.ratio, ratio[i % 2], sizeof friction.ratio);
        for (int lossy = 0; lossy < 2; lossy++) {
            struct toy toy;
            make_ball(&toy, &friction, slip[i / 4][0]);
            toy.gap_rate[2] = slip[i / 4][1];
            if (i / 2 % 2) {
                toy.w[8] = 1.5;
                toy.w[5] = toy.w[7] = 0.8;
            }
            if (lossy)
                toy.laws[0] = contact_law_viscoelastic(1.0, &slight);
            struct impact_outcome outcome = toy_run(&toy, 1e-9, 100.0);
            memcpy(after[lossy], outcome.motion.gap_rate + 1, 2 * sizeof(double));
            after[lossy][2] = outcome.slid;
            toy_free(&toy);
        }
        measured("along", after[1][0], after[0][0], 3e-4);
        measured("across", after[1][1], after[0][1], 3e-4);
        measured("slid", after[1][2], after[0][2], 1e-4);
    }
}

/* What slides throughout in any direction transmits the coefficient's share along it,
 * whatever has relaxed, in few steps: a force that turned to and fro would lack a hundredth of it
 * and take three times as many. */
static void slides_keep_their_direction(void **state)
{
    (void)state;
    const struct relaxation of[] = {relaxation_constant(1.38, 1.0), {1, {0.9}, {0.1}}};
    for (size_t i = 0; i < COUNT(of); i++) {
        struct scene_friction friction = {.coefficient = 0.0358, .ratio = {0.8, 0.0, 0.8}};
        struct toy toy;
        make_ball(&toy, &friction, 0.4);
        toy.gap_rate[2] = 0.28;
        toy.laws[0] = contact_law_viscoelastic(1.0, &of[i]);
        struct impact_outcome outcome = toy_run(&toy, 1e-4, 100.0);
        const double *along = outcome.tracks[0].tangential;
        near_relative(hypot(along[0], along[1]), 0.0358 * outcome.tracks[0].impulse, 1e-13);
        /* across it, what the rounds leave */
        near_relative(along[1], 0.7 * along[0], 1e-10);
        assert_true(outcome.steps < 50);
        toy_free(&toy);
    }
}

/* Hunt and Crossley's law with a residual flexibility that the normal shares with the tangents. The
 * approach whose rate the law has is without it. One that jumped where steps meet, as the tangents'
 * cubics and their forces at the end differ, would gain energy without an end. */
static void rates_are_without_the_tangents(void **state)
{
    (void)state;
    static const double dissipation[] = {0.5, 2.0}, soft[] = {0.2, 0.15, -0.1};
    static const double accuracy[] = {1e-8, 1e-6, 1e-4}, off[] = {0.0, 1e-4, 1e-3};
    for (size_t i = 0; i < COUNT(dissipation) * COUNT(accuracy); i++) {
        struct scene_friction friction = {.coefficient = 0.4, .ratio = {0.8, 0.1, 0.7}};
        static double fine[3];
        size_t a = i % COUNT(accuracy);
        struct toy toy;
        make_ball(&toy, &friction, 1.2);
        toy.gap_rate[2] = -0.2;
        toy.laws[0] = contact_law_dissipative(1.0, 1.5, dissipation[i / COUNT(accuracy)]);
        for (size_t p = 0; p < 9; p++)
            toy.residual[p] = soft[p / 3] * soft[p % 3];
        const struct impact_outcome outcome = toy_run(&toy, accuracy[a], 60.0);
        if (a == 0)
            memcpy(fine, outcome.motion.gap_rate, sizeof fine);
        assert_true(outcome.end_reason == PERCUSS_END_SEPARATED);
        measured("closure", outcome.energy.closure / outcome.energy.available, 0.0, 1e-4);
        for (size_t r = 0; r < 3; r++)
            measured("rate", outcome.motion.gap_rate[r], fine[r], off[a]);
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_spin_by_their_circles),
        cmocka_unit_test(limits_follow_the_rate),
        cmocka_unit_test(second_blows_find_what_was_left),
        cmocka_unit_test(without_a_loss_they_are_the_cells),
        cmocka_unit_test(slides_keep_their_direction),
        cmocka_unit_test(rates_are_without_the_tangents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
