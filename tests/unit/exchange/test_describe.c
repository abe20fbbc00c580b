/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/describe.c: what clients learn about bodies of every shape. */
#include "sample.h"

#include <math.h>

#include "exchange/describe.h"

static void described(const struct body *body, const char *shape, const char *description,
                      const double half_extents[3])
{
    percuss_v1_Body wire;
    percuss_v1_BodySite sites[BODY_MOST_SITES];
    describe_body(body, &wire, sites);
    assert_string_equal(wire.id, body->id);
    assert_string_equal(wire.shape, shape);
    assert_string_equal(wire.material, "steel");
    assert_string_equal(wire.description, description);
    assert_true(wire.mass == body->mass);
    for (int i = 0; i < 3; i++)
        assert_true(wire.half_extents[i] == half_extents[i]);
    bool is_rod = body->kind == &rod_kind;
    assert_true(wire.tip_radius == (is_rod ? body->tip_radius : 0.0));
    assert_true(wire.radius == body->radius);
    assert_int_equal(wire.supports[1], body->supports[1]);
    assert_true(wire.parameters[PERCUSS_PARAMETER_YOUNG] == 7.0);
    bool flexible = is_rod || body->kind == &beam_kind || body->kind == &cylinder_kind ||
                    body->kind == &block_kind;
    assert_int_equal(isnan(wire.parameters[PERCUSS_PARAMETER_DAMPING]), !flexible);
    assert_int_equal(isnan(wire.parameters[PERCUSS_PARAMETER_RADIUS]), body->radius == 0.0);
}

#define COMMON .id = "x", .material.name = "steel", .material.young = 7.0, .mass = 3.0

static void describes_every_shape(void **state)
{
    (void)state;
    struct body sphere = {COMMON, .kind = &sphere_kind, .radius = 0.5};
    described(&sphere, "sphere", "radius 0.5 m", (double[]){0.5, 0.5, 0.5});
    struct body cylinder = {COMMON, .kind = &cylinder_kind, .radius = 0.5, .length = 4.0};
    described(&cylinder, "cylinder", "length 4 m, radius 0.5 m", (double[]){2.0, 0.5, 0.5});
    struct body block = {COMMON, .kind = &block_kind, .size = {1.0, 2.0, 4.0}};
    described(&block, "block", "1 m x 2 m x 4 m", (double[]){0.5, 1.0, 2.0});
    struct body ground = {COMMON, .kind = &half_space_kind};
    described(&ground, "half-space", "fills z <= 0, immovable", (double[]){0.0, 0.0, 0.0});
}

static void describes_rods_and_beams(void **state)
{
    (void)state;
    struct body rod = {COMMON,
                       .kind = &rod_kind,
                       .radius = 0.5,
                       .length = 4.0,
                       .tip_radius = INFINITY,
                       .lateral_inertia = true,
                       .supports = {SUPPORT_FREE, SUPPORT_CLAMPED},
                       .damping = 0.01,
                       .modes = 12};
    described(&rod, "rod",
              "length 4 m, radius 0.5 m, flat tips, lateral inertia, ends free and clamped, modal "
              "damping ratio 0.01, 12 modes",
              (double[]){2.0, 0.5, 0.5});
    struct body beam = {COMMON,
                        .kind = &beam_kind,
                        .width = 1.0,
                        .height = 2.0,
                        .length = 4.0,
                        .shear_factor = {0.8, 0.9},
                        .supports = {SUPPORT_PINNED, SUPPORT_PINNED}};
    described(&beam, "beam",
              "length 4 m, section 1 m x 2 m, Timoshenko, shear factor 0.9, ends pinned and pinned",
              (double[]){2.0, 0.5, 1.0});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(describes_every_shape),
        cmocka_unit_test(describes_rods_and_beams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
