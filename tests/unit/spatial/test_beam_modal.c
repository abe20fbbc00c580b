/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors tests/reference/spatial/beam_modal.c: the paper's beam at 0.2 m/s with a coarse region
 * against the modal solutions with Hertz's law, the books of energy, and a beam without modes,
 * which is a rigid body. */
#include <string.h>

#include "check.h"
#include "spatial/beam_modal.h"

static const struct patch_input input = {
    .materials = {{"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                  {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
    .curvature = {0.5 / 0.015, 0.5 / 0.006},
    .force = 400.0,
    .resolution = 2,
};

static struct patch patch;

static int make_patch(void **state)
{
    (void)state;
    struct fault fault;
    return patch_create(&input, &patch, &fault) != PERCUSS_OK;
}

static int free_patch(void **state)
{
    (void)state;
    patch_free(&patch);
    return 0;
}

static struct beam_modal make(size_t modes)
{
    double r = 0.01, area = M_PI * r * r, second = 0.25 * area * r * r;
    struct beam_plane plane = {.length = 1.0,
                               .bending_stiffness = 70e9 * second,
                               .shear_stiffness =
                                   beam_shear_hutchinson_circle(0.33) * 70e9 / 2.66 * area,
                               .line_mass = 2700.0 * area,
                               .line_inertia = 2700.0 * second};
    struct beam_modal modal;
    assert_true(
        beam_modal_create(&plane, 7800.0 * 4.0 / 3.0 * M_PI * pow(0.015, 3.0), modes, &modal));
    return modal;
}

static void strikes_the_beam(void **state)
{
    (void)state;
    struct beam_modal modal = make(80);
    assert_int_equal(modal.modes, 80);
    struct collision found;
    struct fault fault;
    const struct beam_modal_contact contact = beam_modal_patch(&patch);
    struct beam_modal_settings settings = {.approach = 0.2, .step = 1e-6, .horizon = 0.01};
    assert_int_equal(beam_modal_run(&modal, &contact, &settings, &found, &fault), PERCUSS_OK);
    assert_true(found.over);
    assert_int_equal(found.sub_impacts, 2);
    /* Timoshenko with Hutchinson's factor and Hertz's law: 19.5097e-3 N s, then e = .7390; a region
     * of two bricks on the contact's semi-axis is as stiff as Hertz to a per cent, which moves
     * neither by as much */
    near_relative(found.sub_impact[0].impulse, 19.51e-3, 3e-3);
    near(found.restitution, 0.739, 0.008);
    /* forces that go linearly in a step: second order, some 400 steps of contact */
    near(found.available - found.rebound - found.vibration, 0.0, 1e-5 * found.available);
    beam_modal_free(&modal);
}

static void takes_a_law(void **state)
{
    (void)state;
    /* Hertz's law, exact: Timoshenko with Hutchinson's factor has .7390, 19.5097e-3 N s */
    struct contact_law hertz = contact_law_hertz(patch.hertz.stiffness);
    const struct beam_modal_contact contact = beam_modal_law(&hertz);
    struct beam_modal modal = make(80);
    struct collision found;
    struct fault fault;
    struct beam_modal_settings settings = {.approach = 0.2, .step = 0.5e-6, .horizon = 0.01};
    assert_int_equal(beam_modal_run(&modal, &contact, &settings, &found, &fault), PERCUSS_OK);
    near(found.restitution, 0.7390, 3e-4);
    beam_modal_free(&modal);
}

static void is_rigid_without_modes(void **state)
{
    (void)state;
    struct beam_modal modal = make(1);
    modal.modes = 0;
    modal.residual = 0.0;
    struct collision found;
    struct fault fault;
    const struct beam_modal_contact contact = beam_modal_patch(&patch);
    struct beam_modal_settings settings = {.approach = 0.1, .step = 0.5e-6, .horizon = 0.001};
    assert_int_equal(beam_modal_run(&modal, &contact, &settings, &found, &fault), PERCUSS_OK);
    near(found.restitution, 1.0, 2e-3);
    /* Hertz: 2.9432 d / v with d = (5 v^2 / (4 k W))^(2/5); the region's stiffness to its 2/5 */
    double mobility = 1.0 / modal.mass[0] + 1.0 / modal.mass[1];
    double deepest = pow(1.25 * 0.01 / (patch.hertz.stiffness * mobility), 0.4);
    near_relative(found.sub_impact[0].end - found.sub_impact[0].start, 2.9432 * deepest / 0.1,
                  5e-3);
    beam_modal_free(&modal);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strikes_the_beam),
        cmocka_unit_test(takes_a_law),
        cmocka_unit_test(is_rigid_without_modes),
    };
    return cmocka_run_group_tests(tests, make_patch, free_patch);
}
