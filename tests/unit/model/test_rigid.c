/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/rigid.c: inverse masses and velocity changes from the mass matrix
 * written out, for free, pinned and held bodies. */
#include "check.h"
#include "model/rigid.h"
#include "model/vector.h"

static struct body beam(enum support left, enum support right)
{
    struct body body = {
        .id = "beam",
        .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
        .kind = &beam_kind,
        .width = 0.02,
        .height = 0.05,
        .length = 0.4,
        .tip_radius = INFINITY,
        .supports = {left, right},
    };
    assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
    return body;
}

static const double points[][3] = {{0.2, 0.01, -0.02}, {-0.07, -0.01, 0.025}, {0.0, 0.0, 0.0}};
static const double directions[][3] = {{1.0, 0.0, 0.0}, {0.0, 0.6, 0.8}, {0.48, -0.6, 0.64}};

/* Velocity at a point after a unit impulse: v + omega x r. */
static double by_hand(const struct body *body, const double pi[3], const double di[3],
                      const double pj[3], const double dj[3])
{
    double moment[3], turning[3], carried[3];
    cross3(pj, dj, moment);
    for (int k = 0; k < 3; k++)
        turning[k] = moment[k] / body->inertia[k];
    cross3(turning, pi, carried);
    return dot3(di, dj) / body->mass + dot3(di, carried);
}

static void a_free_body(void **state)
{
    (void)state;
    struct body body = beam(SUPPORT_FREE, SUPPORT_FREE);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double value =
                rigid_inverse_mass(&body, points[i], directions[i], points[j], directions[j]);
            double expected = by_hand(&body, points[i], directions[i], points[j], directions[j]);
            near(value, expected, 1e-13 * (1.0 / body.mass));
            /* Maxwell and Betti */
            near(rigid_inverse_mass(&body, points[j], directions[j], points[i], directions[i]),
                 value, 1e-15 / body.mass * 50.0);
        }
}

/* About a pin at one end: across the axis lever^2/I_pin, along it nothing, in both planes. */
static void a_body_on_a_pin(void **state)
{
    (void)state;
    for (int held = 0; held < 2; held++) {
        struct body body =
            beam(held ? SUPPORT_FREE : SUPPORT_PINNED, held ? SUPPORT_PINNED : SUPPORT_FREE);
        double pin = held ? 0.2 : -0.2;
        const double p[3] = {0.05, 0.0, 0.0};
        const double y[3] = {0.0, 1.0, 0.0}, z[3] = {0.0, 0.0, 1.0}, x[3] = {1.0, 0.0, 0.0};
        double lever = 0.05 - pin;
        double about_z = body.inertia[2] + body.mass * 0.04;
        double about_y = body.inertia[1] + body.mass * 0.04;
        near(rigid_inverse_mass(&body, p, y, p, y), lever * lever / about_z, 1e-15);
        near(rigid_inverse_mass(&body, p, z, p, z), lever * lever / about_y, 1e-15);
        near(rigid_inverse_mass(&body, p, x, p, x), 0.0, 0.0);
        near(rigid_inverse_mass(&body, p, y, p, z), 0.0, 1e-18);
    }
}

/* Rows of an oblique impact: the notes' steel sphere on the paper's beam, 1/kg. Along the axis a
 * force on the side turns the beam by its lever arm: 3.5/m + 1/M + r^2/J, and with the normal
 * x r/J; across the axis it twists: 3.5/m + 1/M + 2/M + x^2/J. */
static void rows_of_an_oblique_impact(void **state)
{
    (void)state;
    struct body sphere = {.id = "ball",
                          .kind = &sphere_kind,
                          .material = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0},
                          .radius = 0.015};
    struct body bar = {.id = "beam",
                       .kind = &beam_kind,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                       .radius = 0.01,
                       .length = 1.0,
                       .tip_radius = INFINITY};
    assert_int_equal(body_complete(&sphere, NULL), PERCUSS_OK);
    assert_int_equal(body_complete(&bar, NULL), PERCUSS_OK);
    static const double t[3][3] = {{0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
    static const double expected[2][4] = {{10.24758, 0.0, 32.92064, 35.27708},
                                          {10.75814, -0.026871, 32.92064, 35.78764}};
    for (int k = 0; k < 2; k++) {
        const double below[3] = {0.0, 0.0, -0.015}, top[3] = {k ? 0.31 - 0.5 : 0.0, 0.0, 0.01};
        double w[3][3];
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                w[i][j] = rigid_inverse_mass(&sphere, below, t[i], below, t[j]) +
                          rigid_inverse_mass(&bar, top, t[i], top, t[j]);
        near(w[0][0], expected[k][0], 5e-6);
        near(w[0][1], expected[k][1], 5e-7);
        near(w[1][0], w[0][1], 1e-16);
        near(w[1][1], expected[k][2], 5e-6);
        near(w[2][2], expected[k][3], 5e-6);
        near(w[0][2], 0.0, 0.0);
        near(w[1][2], 0.0, 0.0);
    }
}

static void held_bodies_do_not_move(void **state)
{
    (void)state;
    static const enum support ends[][2] = {{SUPPORT_PINNED, SUPPORT_PINNED},
                                           {SUPPORT_CLAMPED, SUPPORT_FREE},
                                           {SUPPORT_FREE, SUPPORT_CLAMPED},
                                           {SUPPORT_PINNED, SUPPORT_CLAMPED},
                                           {SUPPORT_CLAMPED, SUPPORT_CLAMPED}};
    for (int i = 0; i < 6; i++) {
        struct body body = beam(ends[i % 5][0], ends[i % 5][1]);
        if (i == 5) {
            body = (struct body){.id = "wall",
                                 .material = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0},
                                 .kind = &half_space_kind,
                                 .tip_radius = INFINITY};
            assert_int_equal(body_complete(&body, NULL), PERCUSS_OK);
        }
        double velocity[3] = {1.0, 2.0, 3.0}, angular[3] = {4.0, 5.0, 6.0};
        near(rigid_inverse_mass(&body, points[0], directions[1], points[0], directions[1]), 0.0,
             0.0);
        rigid_apply_impulse(&body, points[0], directions[1], velocity, angular);
        for (int k = 0; k < 3; k++) {
            near(velocity[k], k + 1.0, 0.0);
            near(angular[k], k + 4.0, 0.0);
        }
    }
}

/* An impulse changes the velocity of any point as rigid_inverse_mass says, and adds to what was. */
static void impulses_and_inverse_masses_agree(void **state)
{
    (void)state;
    static const enum support ends[][2] = {{SUPPORT_FREE, SUPPORT_FREE},
                                           {SUPPORT_PINNED, SUPPORT_FREE},
                                           {SUPPORT_FREE, SUPPORT_PINNED}};
    for (int s = 0; s < 3; s++) {
        struct body body = beam(ends[s][0], ends[s][1]);
        for (int i = 0; i < 9; i++) {
            double velocity[3] = {0.1, 0.2, 0.3}, angular[3] = {0.0, 0.0, 0.0};
            double impulse[3], carried[3];
            const double *from = points[i % 3], *to = points[i / 3];
            scale3(2.5, directions[i % 3], impulse);
            rigid_apply_impulse(&body, from, impulse, velocity, angular);
            sub3(velocity, (double[]){0.1, 0.2, 0.3}, velocity);
            cross3(angular, to, carried);
            add_scaled3(1.0, velocity, carried);
            for (int k = 0; k < 3; k++)
                near(dot3(carried, directions[k]),
                     2.5 * rigid_inverse_mass(&body, to, directions[k], from, directions[i % 3]),
                     1e-13 * 2.5 / body.mass);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_body),
        cmocka_unit_test(a_body_on_a_pin),
        cmocka_unit_test(rows_of_an_oblique_impact),
        cmocka_unit_test(held_bodies_do_not_move),
        cmocka_unit_test(impulses_and_inverse_masses_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
