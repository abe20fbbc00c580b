/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/sensitivity.c: what first and second order say of a sequence of
 * sub-impacts against solutions of the changed scene. */
#include "contact/plastic.h"
#include "impact/oscillator.h"
#include "impact/sensitivity.h"
#include "unit/impact/toy_scene.h"

enum { MODES = 4, SLOW = 2 };

/* A body that swings back under the striker: three sub-impacts. */
static const double omegas[MODES] = {0.6, 2.6, 6.5, 12.0};
static const double shapes[MODES] = {1.5, 1.4, -1.4, 1.3};

/* Steps of this accuracy leave less than 1e-10 of an impulse; and where a contact begins or ends,
 * first order follows the forces at the nodes, whose stiffness has a kink there: it misses 1e-4
 * with the longer steps of 1e-11, and less with the steps. */
static const double FINE = 1e-13;
/* Central differences over this step are off by its square times third derivatives (some 1e3). */
static const double STEP = 1e-5;

static void make(struct toy *toy, size_t modes, double damping)
{
    toy_init(toy, 1);
    toy->gap_rate[0] = -1.0;
    toy->residual[0] = 0.01;
    toy_add(toy, 0, modes, omegas, damping, shapes);
}

/* The impulse of a scene; with a log of it where that is wanted. */
static double impulse_of(const struct scene *scene, struct arena *arena, struct force_log *log,
                         size_t *count)
{
    struct impact_outcome outcome;
    const struct impact_settings settings = {
        .accuracy = FINE, .horizon = 1e3, .max_work = 1e9, .log = log};
    assert_true(impact_create(&outcome, scene, arena));
    assert_int_equal(impact_modal(scene, &settings, arena, &outcome), PERCUSS_OK);
    assert_int_equal(outcome.end_reason, PERCUSS_END_SEPARATED);
    if (count)
        *count = outcome.tracks[0].count;
    return outcome.tracks[0].impulse;
}

static double changed(const struct toy *toy, struct arena *arena, double force, double compliance)
{
    struct scene scene = toy->scene;
    double residual = toy->residual[0] + compliance;
    struct contact_law law = contact_law_rescaled(&toy->laws[0], 1.0 + force, 1.0);
    scene.residual = &residual;
    scene.laws = &law;
    return impulse_of(&scene, arena, NULL, NULL);
}

static void first_order_is_that_of_solutions(double damping)
{
    struct toy toy;
    struct arena arena = {0};
    struct sensitivity tangent;
    size_t count;
    make(&toy, MODES, damping);
    struct force_log log = force_log_make(&arena, 1);
    double impulse = impulse_of(&toy.scene, &arena, &log, &count);
    assert_true(count >= 3);

    const struct sensitivity_source stiffer = {.force = 1.0};
    assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena), &stiffer,
                                        NULL, &tangent),
                     PERCUSS_OK);
    double difference =
        (changed(&toy, &arena, STEP, 0.0) - changed(&toy, &arena, -STEP, 0.0)) / (2.0 * STEP);
    print_message("%zu sub-impacts: impulse %.9g, by force %.9g %.9g\n", count, impulse,
                  tangent.impulse, difference);
    near(tangent.impulse, difference, 1e-5 * fabs(difference));
    assert_true(tangent.largest >= fabs(tangent.impulse));
    assert_true(tangent.strain >= fabs(tangent.impulse) / impulse / (double)count);

    const struct sensitivity_source softer = {.compliance = 1.0};
    assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena), &softer,
                                        NULL, &tangent),
                     PERCUSS_OK);
    difference =
        (changed(&toy, &arena, 0.0, STEP) - changed(&toy, &arena, 0.0, -STEP)) / (2.0 * STEP);
    print_message("by compliance %.9g %.9g\n", tangent.impulse, difference);
    near(tangent.impulse, difference, 1e-5 * fabs(difference));
    toy_free(&toy);
    arena_release(&arena);
}

/* Energy of the difference of two motions of a group of undamped modes. */
static double difference_energy(const struct impact_outcome *a, const struct impact_outcome *b)
{
    double energy = 0.0;
    double time = fmax(a->window, b->window);
    for (size_t k = 0; k < MODES; k++) {
        double q[2] = {a->motion.q[0][k], b->motion.q[0][k]};
        double v[2] = {a->motion.v[0][k], b->motion.v[0][k]};
        oscillator_advance(omegas[k], 0.0, time - a->window, &q[0], &v[0]);
        oscillator_advance(omegas[k], 0.0, time - b->window, &q[1], &v[1]);
        energy += 0.5 * (pow(v[0] - v[1], 2.0) + pow(omegas[k] * (q[0] - q[1]), 2.0));
    }
    return energy;
}

static void vibration_changes_as_that_of_solutions(void **state)
{
    (void)state;
    struct toy toy;
    struct arena arena = {0};
    struct sensitivity tangent;
    struct impact_outcome changed[2];
    make(&toy, MODES, 0.0);
    struct force_log log = force_log_make(&arena, 1);
    impulse_of(&toy.scene, &arena, &log, NULL);
    struct sensitivity_path *path = sensitivity_path_create(&toy.scene, &log, &arena);
    const struct sensitivity_source softer = {.compliance = 1.0};
    assert_int_equal(sensitivity_follow(path, &softer, NULL, &tangent), PERCUSS_OK);
    const double compliance = toy.residual[0];
    for (int side = 0; side < 2; side++) {
        toy.residual[0] = compliance + (side ? STEP : -STEP);
        changed[side] = toy_run(&toy, FINE, 1e3);
    }
    double energy = difference_energy(&changed[0], &changed[1]) / (4.0 * STEP * STEP);
    print_message("energy of the change %.9g %.9g\n", sensitivity_vibration(path, &tangent, 0),
                  energy);
    /* as impulses are, to 1e-5, by their squares */
    near(sensitivity_vibration(path, &tangent, 0), energy, 2e-5 * energy);
    near(sensitivity_vibration(path, &tangent, 1), 0.0, 0.0);
    toy_free(&toy);
    arena_release(&arena);
}

/* Second differences over this step: what solutions leave, 1e-10 or so of an impulse, over its
 * square. */
static const double WIDE = 1e-3;
/* The law's second derivative is like d^(-1/2): what the nodes miss of it where contacts begin and
 * end goes with the root of the steps there, and was 2e-2 with those of 1e-10, 4e-3 with these. */
static const double MISSED = 0.01;

/* Of a law's force that grows exponentially, and of a compliance, one by one and together. */
static void second_order_is_that_of_solutions(void **state)
{
    (void)state;
    static const struct sensitivity_source sources[] = {
        {.force = 1.0, .curved = true},
        {.compliance = 0.1, .curved = true},
        {.force = 0.5, .compliance = -0.1, .curved = true},
    };
    struct toy toy;
    struct arena arena = {0};
    make(&toy, MODES, 0.0);
    struct force_log log = force_log_make(&arena, 1);
    size_t count;
    double impulse = impulse_of(&toy.scene, &arena, &log, &count);
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++) {
        const struct sensitivity_source *source = &sources[i];
        struct sensitivity tangent;
        double both = 0.0;
        assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena),
                                            source, NULL, &tangent),
                         PERCUSS_OK);
        for (int sign = -1; sign <= 1; sign += 2)
            both += changed(&toy, &arena, expm1(sign * WIDE * source->force),
                            sign * WIDE * source->compliance);
        double difference = (both - 2.0 * impulse) / (WIDE * WIDE);
        print_message("curvature %.9g %.9g, slope %.9g\n", tangent.curvature, difference,
                      tangent.impulse);
        near(tangent.curvature, difference, MISSED * fabs(difference));
        /* first order is the same with it */
        struct sensitivity_source straight = *source;
        struct sensitivity first;
        straight.curved = false;
        assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena),
                                            &straight, NULL, &first),
                         PERCUSS_OK);
        near(first.impulse, tangent.impulse, 0.0);
        assert_true(first.strain <= tangent.strain);
        assert_true(0.5 * fabs(tangent.curvature) <= tangent.strain * impulse * (double)count);
        near(first.curvature, 0.0, 0.0);
    }
    toy_free(&toy);
    arena_release(&arena);
}

static void undamped_modes_carry_it(void **state)
{
    (void)state;
    first_order_is_that_of_solutions(0.0);
}

static void damped_modes_carry_it(void **state)
{
    (void)state;
    first_order_is_that_of_solutions(0.02);
}

/* An oscillator that is fast and soft in place of its own compliance: K phi^2 / omega^2 of it is
 * small, and it follows the force by -2 zeta phi^2/omega^3 F' - phi^2/omega^4 F''. */
static void inertia_and_viscosity_are_those_of_fast_oscillators(void **state)
{
    (void)state;
    static const double fast[1] = {100.0};
    static const double share[1] = {2.0};
    static const double dampings[] = {0.0, 0.05};
    for (int i = 0; i < 2; i++) {
        struct toy toy, with;
        struct arena arena = {0};
        struct sensitivity tangent;
        make(&toy, SLOW, 0.0);
        make(&with, SLOW, 0.0);
        toy_add(&with, 1, 1, fast, dampings[i], share);
        double compliance = share[0] * share[0] / (fast[0] * fast[0]);
        with.residual[0] -= compliance;
        struct force_log log = force_log_make(&arena, 1);
        double without = impulse_of(&toy.scene, &arena, &log, NULL);
        double difference = impulse_of(&with.scene, &arena, NULL, NULL) - without;
        const struct sensitivity_source source = {.inertia = compliance / (fast[0] * fast[0]),
                                                  .viscosity =
                                                      2.0 * dampings[i] * compliance / fast[0]};
        assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena),
                                            &source, NULL, &tangent),
                         PERCUSS_OK);
        print_message("by an oscillator %.6g %.6g\n", tangent.impulse, difference);
        /* touch and release, where F is like t^1.5, are not slow: at 60 rad/s it is 0.05 off, at
         * 100 rad/s 0.02 */
        near(tangent.impulse, difference, 0.03 * fabs(difference));
        toy_free(&toy);
        toy_free(&with);
        arena_release(&arena);
    }
}

static void a_log_of_nothing_changes_nothing(void **state)
{
    (void)state;
    struct toy toy;
    struct arena arena = {0};
    struct sensitivity tangent;
    make(&toy, MODES, 0.0);
    const struct force_log log = force_log_make(&arena, 1);
    const struct sensitivity_source source = {.force = 1.0};
    assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena), &source,
                                        NULL, &tangent),
                     PERCUSS_OK);
    near(tangent.impulse, 0.0, 0.0);
    near(tangent.strain, 0.0, 0.0);
    toy_free(&toy);
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamped_modes_carry_it),
        cmocka_unit_test(damped_modes_carry_it),
        cmocka_unit_test(vibration_changes_as_that_of_solutions),
        cmocka_unit_test(second_order_is_that_of_solutions),
        cmocka_unit_test(inertia_and_viscosity_are_those_of_fast_oscillators),
        cmocka_unit_test(a_log_of_nothing_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
