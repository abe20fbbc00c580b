/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/friction.c: closed forms of the law alone, and spheres that hit a
 * surface at an angle, against a foundation of 2000 cells in 40000 steps and the annuli of Maw,
 * Barber and Fawcett, both by programs of their own. */
#include "contact/friction.h"

#include <math.h>
#include <string.h>

#include "check.h"
#include "physics/oblique_values.h"

static const double EQUAL[3] = {1.0, 0.0, 1.0};

static struct friction unit_friction(struct contact_law *law, size_t cells, struct arena *arena)
{
    struct friction friction;
    *law = contact_law_hertz(1.0);
    assert_true(friction_create(&friction, 1.0, EQUAL, cells, arena));
    friction_touch(&friction, law, 1.0);
    return friction;
}

/* A touch may begin by any number: a slip that turns has its limit's size down to the smallest. */
static void from_the_smallest(void **state)
{
    (void)state;
    struct arena arena = {0};
    for (int exponent = 0; exponent > -200; exponent--) {
        struct contact_law law;
        struct friction friction = unit_friction(&law, 16, &arena);
        double d = pow(10.0, exponent), most = pow(1.5 * d, 1.5), force[2];
        friction_walk(&friction, d, (const double[2]){2.0 * d, d}, force);
        friction_walk(&friction, 1.5 * d, (const double[2]){2.0 * d, 9.0 * d}, force);
        /* below it squares of forces are 0, and it sticks */
        if (exponent > -100)
            near_relative(hypot(force[0], force[1]), most, 1e-2);
        assert_true(isfinite(force[0]) && isfinite(force[1]) && isfinite(friction.lost));
    }
    arena_release(&arena);
}

/* At a fixed indentation S = 1 - (1 - U)^1.5, back along twice that curve (Masing), and a full
 * cycle loses its area. */
static void cycles_of_displacement(void **state)
{
    (void)state;
    struct arena arena = {0};
    struct contact_law law;
    struct friction friction = unit_friction(&law, 256, &arena);
    double force[2], lost = 0.0;
    friction_walk(&friction, 1.0, (const double[2]){0.0, 0.0}, force);
    for (int i = 1; i <= 800; i++)
        friction_walk(&friction, 1.0, (const double[2]){1e-3 * i, 0.0}, force);
    near(force[0], 1.0 - pow(0.2, 1.5), 2e-5);
    near(force[1], 0.0, 0.0);
    double top = force[0];
    for (int i = 799; i >= -800; i--) {
        friction_walk(&friction, 1.0, (const double[2]){1e-3 * i, 0.0}, force);
        double back = 1.0 - pow(1.0 - 0.5 * (0.8 - 1e-3 * i), 1.5);
        near(force[0], top - 2.0 * back, 4e-5);
        if (i == 0)
            lost = friction.lost;
    }
    near(force[0], -top, 4e-5);
    /* from end to end: 4 int_0^0.8 (1 - (1 - x)^1.5) dx less the rectangle 2 * 0.8 * top */
    lost = friction.lost;
    for (int i = -799; i <= 800; i++)
        friction_walk(&friction, 1.0, (const double[2]){1e-3 * i, 0.0}, force);
    near(friction.lost - lost, 0.171726, 1e-4);
    arena_release(&arena);
}

/* Displacement in proportion to the indentation: below the coefficient over kappa nothing slips. */
static void in_proportion(void **state)
{
    (void)state;
    static const double rates[] = {0.7, 1.3};
    struct arena arena = {0};
    for (size_t r = 0; r < COUNT(rates); r++) {
        struct contact_law law;
        struct friction friction = unit_friction(&law, 64, &arena);
        double force[2];
        for (int i = 1; i <= 100; i++) {
            double d = 0.01 * i;
            friction_walk(&friction, d, (const double[2]){0.0, rates[r] * d}, force);
            near_relative(force[1], fmin(rates[r], 1.0) * pow(d, 1.5), 1e-12);
        }
        assert_true((friction.lost > 0.0) == (rates[r] > 1.0));
    }
    arena_release(&arena);
}

/* A contact that slides on is dragged along the way, whatever the ellipse of its stiffness. */
static void against_the_slip(void **state)
{
    (void)state;
    static const double ratios[][3] = {{1.0, 0.0, 1.0}, {0.7, 0.0, 0.9}, {0.8, 0.1, 1.0}};
    struct arena arena = {0};
    for (size_t r = 0; r < COUNT(ratios); r++)
        for (int degrees = 0; degrees < 180; degrees += 15) {
            struct contact_law law;
            struct friction friction = unit_friction(&law, 64, &arena);
            double about = degrees * M_PI / 180.0, force[2];
            memcpy(friction.ratio, ratios[r], sizeof friction.ratio);
            friction_touch(&friction, &law, 1.0);
            friction_walk(&friction, 1.0, (const double[2]){0.0, 0.3}, force);
            for (int i = 1; i <= 200; i++)
                friction_walk(&friction, 1.0,
                              (const double[2]){0.1 * i * cos(about), 0.3 + 0.1 * i * sin(about)},
                              force);
            near(force[0], cos(about), 1e-4);
            near(force[1], sin(about), 1e-4);
            near_relative(hypot(force[0], force[1]), 1.0, 1e-7);
        }
    arena_release(&arena);
}

/* A slip that turns: an eighth of a circle in steps of 1/8 and of 1/64 of the limit's elastic
 * displacement. The force lags behind it. */
static void around_a_circle(void **state)
{
    (void)state;
    static const double ratios[][3] = {{1.0, 0.0, 1.0}, {0.7, 0.0, 0.9}};
    struct arena arena = {0};
    for (size_t r = 0; r < COUNT(ratios); r++) {
        double end[2][2];
        for (int fine = 0; fine < 2; fine++) {
            struct contact_law law;
            struct friction friction = unit_friction(&law, 64, &arena);
            int steps = fine ? 96 : 12;
            memcpy(friction.ratio, ratios[r], sizeof friction.ratio);
            friction_touch(&friction, &law, 1.0);
            friction_walk(&friction, 1.0, (const double[2]){0.0, 0.0}, end[fine]);
            friction_walk(&friction, 1.0, (const double[2]){4.0, 0.0}, end[fine]);
            for (int i = 1; i <= steps; i++) {
                double about = 0.25 * M_PI * i / steps;
                friction_walk(&friction, 1.0,
                              (const double[2]){2.0 + 2.0 * cos(about), 2.0 * sin(about)},
                              end[fine]);
            }
        }
        near(end[0][0], end[1][0], 6e-3);
        near(end[0][1], end[1][1], 6e-3);
        assert_true(end[1][1] > 0.3);
    }
    arena_release(&arena);
}

/* Way of an eighth of a circle in so many steps, curved or along their chords, after one that
 * slides: the force at the end. */
static void follow_circle(const double ratio[3], double radius, int steps, bool curved,
                          struct arena *arena, double force[2])
{
    struct contact_law law;
    struct friction friction = unit_friction(&law, 64, arena);
    memcpy(friction.ratio, ratio, sizeof friction.ratio);
    friction_touch(&friction, &law, 1.0);
    friction_walk(&friction, 1.0, (const double[2]){0.0, -8.0}, force);
    friction_walk(&friction, 1.0, (const double[2]){0.0, 0.0}, force);
    for (int i = 1; i <= steps; i++) {
        double about = 0.25 * M_PI * i / steps;
        const double to[2] = {radius * (cos(about) - 1.0), radius * sin(about)};
        double arc = radius * 0.25 * M_PI / steps;
        const double rate[3] = {0.0, -arc * sin(about), arc * cos(about)};
        friction_walk_curved(&friction, 1.0, to, curved ? rate : NULL, force);
    }
}

/* Slips that turn by 7.5 and 15 degrees a step on ways of 1, 6 and 40 of the limit's elastic
 * displacement, against 1500 chords, which a force lags behind. Of the error of as few chords, half
 * of a step's turn on long ways, a thirtieth is left; of an ellipse's a half, as its stiffness
 * turns the force, too. */
static void on_curved_ways(void **state)
{
    (void)state;
    static const double ratios[][3] = {{1.0, 0.0, 1.0}, {0.8, 0.0, 0.9}};
    static const double radii[] = {1.3, 8.0, 50.0}, right[] = {1.0 / 30.0, 0.5};
    struct arena arena = {0};
    for (size_t r = 0; r < COUNT(ratios); r++)
        for (size_t i = 0; i < COUNT(radii); i++)
            for (int steps = 3; steps <= 6; steps += 3) {
                double force[2], fine[2], chords[2];
                follow_circle(ratios[r], radii[i], steps, true, &arena, force);
                follow_circle(ratios[r], radii[i], steps, false, &arena, chords);
                follow_circle(ratios[r], radii[i], 1500, false, &arena, fine);
                double was = hypot(chords[0] - fine[0], chords[1] - fine[1]);
                near(hypot(force[0] - fine[0], force[1] - fine[1]), 0.0, right[r] * was);
                assert_true(was > 2e-3);
            }
    arena_release(&arena);
}

static struct material elastic(double young, double poisson)
{
    return (struct material){"metal", young, poisson, 7800.0, INFINITY, 0.0};
}

static void ratios_of_ellipses(void **state)
{
    (void)state;
    struct material steel = elastic(210e9, 0.3), aluminium = elastic(73e9, 0.33);
    double modulus = hertz_effective_modulus(&steel, &aluminium);
    struct hertz_contact circle = hertz_contact_make(modulus, 1.0, 1.0);
    double ratio[2];
    friction_ratios(&circle, &steel, &steel, ratio);
    near_relative(ratio[0], 2.0 * 0.7 / 1.7, 1e-14);
    near_relative(ratio[1], ratio[0], 1e-14);
    /* between nu = 0.3 and 0.33 by the shear compliances */
    double g[2] = {material_shear_modulus(&steel), material_shear_modulus(&aluminium)};
    friction_ratios(&circle, &steel, &aluminium, ratio);
    near_relative(ratio[0], (0.7 / g[0] + 0.67 / g[1]) / (0.85 / g[0] + 0.835 / g[1]), 1e-14);
    /* a slender ellipse: K grows and D with it, B tends to 1: kappa_major to 1 - nu, minor to 1 */
    struct hertz_contact slender = hertz_contact_make(modulus, 1.0, 1e9);
    friction_ratios(&slender, &steel, &steel, ratio);
    assert_true(ratio[0] > 0.7 && ratio[0] < 0.75);
    assert_true(ratio[1] < 1.0 && ratio[1] > 0.95);
}

/* A solid sphere on an equal half-space, nu = 0.3, by Verlet's method with so many steps a contact;
 * psi = kappa (tangential speed of the surface) / (mu (speed of approach)) before and after. */
struct oblique {
    double inverse[2], before[2]; /* inverse mass of the surface over 1/m, and psi */
    double after[2];
    double balance; /* energy that the audit misses, over that before */
};

static double kinetic(const struct oblique *oblique, double normal, const double u[2])
{
    double sum = 0.5 * normal * normal;
    for (int j = 0; j < 2; j++)
        sum += 0.5 * u[j] * u[j] / oblique->inverse[j];
    return sum;
}

static void hit(struct oblique *oblique, size_t cells, int steps)
{
    static const double mu = 0.3, kappa = 1.4 / 1.7;
    struct arena arena = {0};
    struct contact_law law = contact_law_hertz(1.0);
    struct friction friction;
    const double ratio[3] = {kappa, 0.0, kappa};
    double depth = pow(1.25, 0.4), h = 2.9432752 * depth / steps;
    double d = 0.0, rate = 1.0, u[2] = {0.0, 0.0}, v[2], force[2] = {0.0, 0.0}, slope;
    assert_true(friction_create(&friction, mu, ratio, cells, &arena));
    friction_touch(&friction, &law, depth);
    for (int j = 0; j < 2; j++)
        v[j] = oblique->before[j] * mu / kappa;
    double energy = kinetic(oblique, rate, v), f = 0.0;
    do {
        rate -= 0.5 * h * f;
        d += h * rate;
        for (int j = 0; j < 2; j++) {
            v[j] -= 0.5 * h * oblique->inverse[j] * force[j];
            u[j] += h * v[j];
        }
        f = contact_law_force(&law, d, &slope);
        friction_walk(&friction, d, u, force);
        rate -= 0.5 * h * f;
        for (int j = 0; j < 2; j++)
            v[j] -= 0.5 * h * oblique->inverse[j] * force[j];
    } while (d > 0.0);
    for (int j = 0; j < 2; j++)
        oblique->after[j] = v[j] * kappa / mu;
    oblique->balance = (kinetic(oblique, rate, v) + friction.lost - energy) / energy;
    near(friction_stored(&friction), 0.0, 0.0);
    arena_release(&arena);
}

static void spheres_at_angles(void **state)
{
    (void)state;
    const double(*psi)[2] = SPHERE_PSI;
    for (size_t i = 0; i < COUNT(SPHERE_PSI); i++) {
        struct oblique sphere = {{3.5, 3.5}, {psi[i][0], 0.0}, {0.0, 0.0}, 0.0};
        hit(&sphere, 256, 4000);
        /* steps and cells leave 3e-5 each, and the values have four digits */
        near(sphere.after[0], psi[i][1], 1e-4);
        near(sphere.after[1], 0.0, 0.0);
        near(sphere.balance, 0.0, 1e-5);
    }
    /* it slides throughout: the force is the coefficient's share to rounding */
    struct oblique sliding = {{3.5, 3.5}, {6.5, 0.0}, {0.0, 0.0}, 0.0};
    hit(&sliding, 64, 4000);
    near(sliding.after[0], 6.5 - 4.0 * 1.75 * 1.4 / 1.7, 2e-6);
}

/* Any direction is that of one, turned. */
static void in_two_directions(void **state)
{
    (void)state;
    struct oblique one = {{3.5, 3.5}, {3.0, 0.0}, {0.0, 0.0}, 0.0};
    struct oblique turned = {{3.5, 3.5}, {2.4, 1.8}, {0.0, 0.0}, 0.0};
    hit(&one, 64, 1000);
    hit(&turned, 64, 1000);
    near(turned.after[0], 0.8 * one.after[0], 1e-12);
    near(turned.after[1], 0.6 * one.after[0], 1e-12);
    /* chi = 1.4412 along, 1 across: by a foundation of 2000 cells */
    static const double two[][4] = {
        {1.5, 1.0, -0.5362, -0.7410}, {2.4, 1.8, -0.9181, -0.9794}, {3.0, 3.0, -0.3851, -0.1766}};
    for (size_t i = 0; i < COUNT(two); i++) {
        struct oblique sphere = {
            {3.5, 3.5 / (1.75 * 1.4 / 1.7)}, {two[i][0], two[i][1]}, {0.0, 0.0}, 0.0};
        /* Verlet's steps leave 5e-5, of first order, and the values have four digits */
        hit(&sphere, 256, 16000);
        near(sphere.after[0], two[i][2], 1e-4);
        near(sphere.after[1], two[i][3], 1e-4);
    }
}

/* A sphere falls straight into a right-angled groove of its own material, without spin: both walls
 * are compressed and sheared alike. Rebound over approach, whatever the speed. */
static void in_a_groove(void **state)
{
    (void)state;
    const double(*rebound)[2] = GROOVE_REBOUND;
    struct arena arena = {0};
    struct contact_law law = contact_law_hertz(1.0);
    for (size_t i = 0; i < COUNT(GROOVE_REBOUND); i++) {
        struct friction friction;
        double z = 0.0, rate = 1.0, f = 0.0, force[2] = {0.0, 0.0}, slope, h = 1e-3;
        assert_true(friction_create(&friction, rebound[i][0],
                                    (const double[3]){1.4 / 1.7, 0.0, 1.4 / 1.7}, 256, &arena));
        friction_touch(&friction, &law, 1.5);
        do {
            rate -= 0.5 * h * M_SQRT2 * (f + force[0]);
            z += h * rate;
            f = contact_law_force(&law, z * M_SQRT1_2, &slope);
            friction_walk(&friction, z * M_SQRT1_2, (const double[2]){z * M_SQRT1_2, 0.0}, force);
            rate -= 0.5 * h * M_SQRT2 * (f + force[0]);
        } while (z > 0.0);
        near(-rate, rebound[i][1], 2e-5);
        near(0.5 * rate * rate + 2.0 * friction.lost, 0.5, 1e-5);
    }
    arena_release(&arena);
}

/* A slide loses what its limit works: while d = t (2 - t) and u = 4 t + t^2/2 from touch to end,
 * F = d^(3/2), 15 pi/8. Of 8 and 16 parts, most of it in the last one, which opens; by their chords
 * it is 5.1e-2 and 1.1e-2. */
static void loss_of_a_slide(void **state)
{
    (void)state;
    struct arena arena = {0};
    static const double right[] = {3.5e-2, 7e-3};
    for (int k = 0; k < 2; k++) {
        struct contact_law law;
        struct friction friction = unit_friction(&law, 64, &arena);
        int parts = 8 << k;
        double h = 2.0 / parts, force[2];
        for (int i = 1; i <= parts; i++) {
            double t = h * i;
            const double u[2] = {4.0 * t + 0.5 * t * t, 0.0};
            const double rate[3] = {h * (2.0 - 2.0 * t), h * (4.0 + t), 0.0};
            friction_walk_curved(&friction, t * (2.0 - t), u, rate, force);
        }
        near_relative(friction.lost, 15.0 * M_PI / 8.0, right[k]);
    }
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_the_smallest),      cmocka_unit_test(against_the_slip),
        cmocka_unit_test(around_a_circle),        cmocka_unit_test(on_curved_ways),
        cmocka_unit_test(cycles_of_displacement), cmocka_unit_test(in_proportion),
        cmocka_unit_test(ratios_of_ellipses),     cmocka_unit_test(spheres_at_angles),
        cmocka_unit_test(in_two_directions),      cmocka_unit_test(in_a_groove),
        cmocka_unit_test(loss_of_a_slide),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
