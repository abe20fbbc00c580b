/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/reference.c: oblique impacts of rigid bodies by CVODE, against a
 * foundation of 2000 cells in 40000 steps (test_friction.c) and the modal method. */
#include <math.h>

#include "contact/friction.h"
#include "physics/oblique_values.h"
#include "unit/impact/toy_scene.h"

static const double MU = 0.3, KAPPA = 1.4 / 1.7;

static struct impact_outcome by_cvode(struct toy *toy, double accuracy)
{
    struct impact_settings settings = {.accuracy = accuracy, .horizon = 100.0, .max_work = 1e12};
    struct impact_outcome outcome;
    assert_true(impact_create(&outcome, &toy->scene, &toy->arena));
    assert_int_equal(impact_cvode(&toy->scene, &settings, &toy->arena, &outcome), PERCUSS_OK);
    return outcome;
}

/* A solid sphere of unit mass that hits a half-space of its own material, nu = 0.3, at unit speed,
 * its surface sliding with psi mu/kappa along two tangents. */
static void make_sphere_toy(struct toy *toy, struct scene_friction *friction, const double psi[2])
{
    toy_init(toy, 1);
    *friction = (struct scene_friction){.coefficient = MU, .ratio = {KAPPA, 0.0, KAPPA}};
    scene_set_frictions(&toy->scene, 1);
    toy->scene.friction = friction;
    toy->w[4] = toy->w[8] = 3.5;
    toy->gap_rate[0] = -1.0;
    for (int j = 0; j < 2; j++)
        toy->gap_rate[1 + j] = psi[j] * MU / KAPPA;
}

/* The books of one contact by both methods. */
static void same_books(const struct impact_outcome *cvode, const struct impact_outcome *modal,
                       double right)
{
    const struct track *a = &cvode->tracks[0], *b = &modal->tracks[0];
    assert_int_equal(a->count, b->count);
    near_relative(a->impulse, b->impulse, right);
    /* of the modal method by the nodes at which the gap shrinks */
    near(b->compressed, a->compressed, 1e-4);
    near(b->released, a->released, 1e-4);
    near(cvode->energy.friction, modal->energy.friction, right);
    assert_int_equal(a->list[0].friction_state, b->list[0].friction_state);
    for (int t = 0; t < 2; t++) {
        near(a->tangential[t], b->tangential[t], right);
        near(a->list[0].slip_before[t], b->list[0].slip_before[t], 1e-12);
        near(a->list[0].slip_after[t], b->list[0].slip_after[t], 3.5 * right);
        near(cvode->motion.gap_rate[1 + t], modal->motion.gap_rate[1 + t], 3.5 * right);
    }
}

/* Each accuracy to itself, and to the half digit of the values. */
static void spheres_at_angles(void **state)
{
    (void)state;
    static const double accuracies[] = {1e-4, 1e-6, 1e-8};
    for (size_t a = 0; a < COUNT(accuracies); a++)
        for (size_t i = 0; i < COUNT(SPHERE_PSI); i++) {
            struct toy toy;
            struct scene_friction friction;
            make_sphere_toy(&toy, &friction, (const double[2]){SPHERE_PSI[i][0], 0.0});
            struct impact_outcome outcome = by_cvode(&toy, accuracies[a]);
            near(outcome.motion.gap_rate[1] * KAPPA / MU, SPHERE_PSI[i][1], accuracies[a] + 6e-5);
            near(outcome.motion.gap_rate[2], 0.0, 0.0);
            near(outcome.motion.gap_rate[0], 1.0, accuracies[a]);
            near(outcome.energy.closure / outcome.energy.available, 0.0, fmax(accuracies[a], 1e-7));
            near(outcome.tracks[0].compressed, 0.5, accuracies[a] + 1e-7);
            near(outcome.tracks[0].released, 0.5, accuracies[a] + 1e-7);
            if (accuracies[a] == 1e-8) {
                struct impact_outcome modal = toy_run(&toy, 1e-8, 100.0);
                same_books(&outcome, &modal, 2e-5);
            }
            toy_free(&toy);
        }
}

/* A contact that slides throughout transmits the coefficient's share; a slip askew is one along a
 * tangent, turned; and the displacement before the touch has no effect. */
static void in_any_direction(void **state)
{
    (void)state;
    struct toy toy;
    struct scene_friction friction;
    make_sphere_toy(&toy, &friction, (const double[2]){6.5, 0.0});
    struct impact_outcome sliding = by_cvode(&toy, 1e-8);
    near_relative(sliding.tracks[0].tangential[0], -MU * sliding.tracks[0].impulse, 1e-9);
    assert_int_equal(sliding.tracks[0].list[0].friction_state, PERCUSS_FRICTION_STATE_SLID);
    toy_free(&toy);
    make_sphere_toy(&toy, &friction, (const double[2]){3.0, 0.0});
    double speed = by_cvode(&toy, 1e-8).motion.gap_rate[1];
    toy.gap[1] = 2.0;
    near(by_cvode(&toy, 1e-8).motion.gap_rate[1], speed, 1e-8);
    toy_free(&toy);
    make_sphere_toy(&toy, &friction, (const double[2]){2.4, 1.8});
    struct impact_outcome turned = by_cvode(&toy, 1e-8);
    near(turned.motion.gap_rate[1], 0.8 * speed, 1e-7);
    near(turned.motion.gap_rate[2], 0.6 * speed, 1e-7);
    toy_free(&toy);
}

/* A sphere falls straight into a right-angled groove of its own material, without spin: two
 * contacts at once, each normal along the other's tangent. */
static void in_a_groove(void **state)
{
    (void)state;
    enum { ROWS = 6 };
    /* axes x, z and the spin's radius, as in test_friction_step.c */
    static const double x[ROWS] = {M_SQRT1_2, -M_SQRT1_2, M_SQRT1_2, 0.0, -M_SQRT1_2, 0.0};
    static const double z[ROWS] = {M_SQRT1_2, M_SQRT1_2, -M_SQRT1_2, 0.0, -M_SQRT1_2, 0.0};
    static const double turn[ROWS] = {0.0, 0.0, 1.0, 0.0, -1.0, 0.0};
    for (size_t i = 0; i < COUNT(GROOVE_REBOUND); i++) {
        struct toy toy;
        struct scene_friction friction[2];
        toy_init(&toy, 2);
        for (size_t c = 0; c < 2; c++)
            friction[c] = (struct scene_friction){
                .contact = c, .coefficient = GROOVE_REBOUND[i][0], .ratio = {KAPPA, 0.0, KAPPA}};
        scene_set_frictions(&toy.scene, 2);
        toy.scene.friction = friction;
        for (size_t a = 0; a < ROWS; a++)
            for (size_t b = 0; b < ROWS; b++)
                toy.w[a * ROWS + b] = x[a] * x[b] + z[a] * z[b] + 2.5 * turn[a] * turn[b] +
                                      (a == b && (a == 3 || a == 5) ? 3.5 : 0.0);
        for (size_t r = 0; r < ROWS; r++)
            toy.gap_rate[r] = -z[r];
        struct impact_outcome outcome = by_cvode(&toy, 1e-7);
        for (int c = 0; c < 2; c++)
            near(outcome.motion.gap_rate[c] * M_SQRT2, GROOVE_REBOUND[i][1], 1e-4);
        near(outcome.energy.closure / outcome.energy.available, 0.0, 1e-5);
        toy_free(&toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_at_angles),
        cmocka_unit_test(in_any_direction),
        cmocka_unit_test(in_a_groove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
