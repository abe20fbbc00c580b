/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/sensitivity_group.c: what first order says of contacts that feel each
 * other against solutions of the changed scene. */
#include "contact/plastic.h"
#include "impact/sensitivity_group.h"
#include "unit/impact/toy_scene.h"

enum { CONTACTS = 3, MODES = 4 };

/* A body that swings under three strikers, which share it. */
static const double omegas[MODES] = {0.6, 2.6, 6.5, 12.0};
static const double shapes[CONTACTS * MODES] = {1.5, 1.4, -1.4, 1.3,  1.2, -0.9,
                                                0.8, 1.1, 0.7,  -1.2, 1.0, -0.6};
static const double speeds[CONTACTS] = {-1.0, -0.6, -0.8};

/* First order follows the forces at the nodes, whose stiffness has a kink where a contact begins or
 * ends: it misses 3e-5 with steps of this accuracy, less with shorter ones. */
static const double FINE = 1e-13;
/* Central differences over this step are off by its square times third derivatives (some 1e3). */
static const double STEP = 1e-4;

static void make(struct toy *toy, double damping)
{
    toy_init(toy, CONTACTS);
    for (size_t a = 0; a < CONTACTS; a++) {
        toy->gap_rate[a] = speeds[a];
        for (size_t b = 0; b < CONTACTS; b++) {
            toy->w[a * CONTACTS + b] = a == b ? 1.0 : 0.2;
            toy->residual[a * CONTACTS + b] = a == b ? 0.01 : 0.002;
        }
    }
    toy_add(toy, 0, MODES, omegas, damping, shapes);
}

/* The contacts' impulses; with a log where that is wanted. */
static void impulses_of(const struct scene *scene, struct arena *arena, struct force_log *log,
                        double impulse[CONTACTS])
{
    struct impact_outcome outcome;
    const struct impact_settings settings = {
        .accuracy = FINE, .horizon = 1e3, .max_work = 1e9, .log = log};
    assert_true(impact_create(&outcome, scene, arena));
    assert_int_equal(impact_modal(scene, &settings, arena, &outcome), PERCUSS_OK);
    assert_int_equal(outcome.end_reason, PERCUSS_END_SEPARATED);
    for (size_t c = 0; c < CONTACTS; c++)
        impulse[c] = outcome.tracks[c].impulse;
}

/* The same of a scene that a share of the sources has changed. */
static void changed(const struct toy *toy, struct arena *arena,
                    const struct sensitivity_source *source, double share, double impulse[CONTACTS])
{
    struct scene scene = toy->scene;
    double residual[CONTACTS * CONTACTS];
    struct contact_law laws[CONTACTS];
    memcpy(residual, toy->residual, sizeof residual);
    for (size_t c = 0; c < CONTACTS; c++) {
        residual[c * (CONTACTS + 1)] += share * source[c].compliance;
        laws[c] = contact_law_rescaled(&toy->laws[c], 1.0 + share * source[c].force, 1.0);
    }
    scene.residual = residual;
    scene.laws = laws;
    impulses_of(&scene, arena, NULL, impulse);
}

static void check_against_solutions(const struct toy *toy, struct arena *arena,
                                    const struct sensitivity_source *source,
                                    const struct sensitivity_group *tangent)
{
    double more[CONTACTS];
    double less[CONTACTS];
    changed(toy, arena, source, STEP, more);
    changed(toy, arena, source, -STEP, less);
    for (size_t c = 0; c < CONTACTS; c++) {
        double difference = (more[c] - less[c]) / (2.0 * STEP);
        print_message("contact %zu: %.9g %.9g\n", c, tangent->impulse[c], difference);
        near(tangent->impulse[c], difference, 1e-4 * fabs(difference));
        assert_true(fabs(difference) > 1e-3);
    }
    assert_true(tangent->strain > 0.0 && isfinite(tangent->strain));
}

/* All contacts stiffer and one of them softer in series, followed side by side. */
static void first_order_is_that_of_solutions(double damping)
{
    static const struct sensitivity_source stiffer[CONTACTS] = {
        {.force = 1.0}, {.force = 1.0}, {.force = 1.0}};
    static const struct sensitivity_source softer[CONTACTS] = {[1] = {.compliance = 1.0}};
    struct toy toy;
    struct arena arena = {0};
    struct sensitivity_group tangent[2];
    double impulse[CONTACTS];
    make(&toy, damping);
    struct force_log log = force_log_make(&arena, CONTACTS);
    impulses_of(&toy.scene, &arena, &log, impulse);
    const struct sensitivity_group_task task = {&toy.scene, &log, 2, {stiffer, softer}};
    assert_int_equal(sensitivity_group_follow(&task, &arena, NULL, tangent), PERCUSS_OK);
    check_against_solutions(&toy, &arena, stiffer, &tangent[0]);
    check_against_solutions(&toy, &arena, softer, &tangent[1]);
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

/* Of one contact both ways are the same, through all kinds of sources. */
static void one_contact_is_that_of_tangent(void **state)
{
    (void)state;
    static const struct sensitivity_source source = {
        .force = 0.3, .compliance = 0.2, .viscosity = 0.1, .inertia = 0.05};
    struct toy toy;
    struct arena arena = {0};
    struct sensitivity alone;
    struct sensitivity_group group;
    struct impact_outcome outcome;
    toy_init(&toy, 1);
    toy.gap_rate[0] = -1.0;
    toy.residual[0] = 0.01;
    toy_add(&toy, 0, MODES, omegas, 0.0, shapes);
    struct force_log log = force_log_make(&arena, 1);
    const struct impact_settings settings = {
        .accuracy = FINE, .horizon = 1e3, .max_work = 1e9, .log = &log};
    assert_true(impact_create(&outcome, &toy.scene, &arena));
    assert_int_equal(impact_modal(&toy.scene, &settings, &arena, &outcome), PERCUSS_OK);
    const struct sensitivity_group_task task = {&toy.scene, &log, 1, {&source}};
    assert_int_equal(sensitivity_group_follow(&task, &arena, NULL, &group), PERCUSS_OK);
    assert_int_equal(sensitivity_follow(sensitivity_path_create(&toy.scene, &log, &arena), &source,
                                        NULL, &alone),
                     PERCUSS_OK);
    near(group.impulse[0], alone.impulse, 1e-9 * fabs(alone.impulse));
    toy_free(&toy);
    arena_release(&arena);
}

static void a_log_of_nothing_changes_nothing(void **state)
{
    (void)state;
    static const struct sensitivity_source source[CONTACTS] = {{.force = 1.0}};
    struct toy toy;
    struct arena arena = {0};
    struct sensitivity_group tangent;
    make(&toy, 0.0);
    const struct force_log log = force_log_make(&arena, CONTACTS);
    const struct sensitivity_group_task task = {&toy.scene, &log, 1, {source}};
    assert_int_equal(sensitivity_group_follow(&task, &arena, NULL, &tangent), PERCUSS_OK);
    near(tangent.impulse[0], 0.0, 0.0);
    near(tangent.strain, 0.0, 0.0);
    toy_free(&toy);
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undamped_modes_carry_it),
        cmocka_unit_test(damped_modes_carry_it),
        cmocka_unit_test(one_contact_is_that_of_tangent),
        cmocka_unit_test(a_log_of_nothing_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
