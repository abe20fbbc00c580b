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
    struct describer describer;
    assert_true(describe_begin(&describer, &(struct body_set){0}));
    describe_body(&describer, body, &wire);
    describe_end(&describer);
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
    const double at = wire.losses._buffer->loss_frequency;
    assert_true(body->loss_frequency > 0.0 ? at == body->loss_frequency : isnan(at));
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
    struct body rubber = {COMMON, .kind = &sphere_kind, .radius = 0.5, .loss_factor = 0.2};
    described(&rubber, "sphere", "radius 0.5 m, loss factor 0.2", (double[]){0.5, 0.5, 0.5});
    rubber.loss_frequency = 10.0;
    described(&rubber, "sphere", "radius 0.5 m, loss factor 0.2 at 10 Hz",
              (double[]){0.5, 0.5, 0.5});
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

static void check_losses(const percuss_v1_Body *body)
{
    assert_int_equal(body->losses._length, 1);
    const percuss_v1_MaterialLosses *losses = body->losses._buffer;
    assert_true(isnan(losses->loss_factor) && isnan(losses->loss_frequency));
    assert_true(isnan(losses->rate_coefficient));
    assert_true(losses->rate_reference == 40.0 && losses->rate_exponent == 5.0);
    assert_int_equal(losses->relaxation._length, 1);
    assert_true(losses->relaxation._buffer[0].share == 0.2 &&
                losses->relaxation._buffer[0].time == 1e-3);
}

static void check_points(const percuss_v1_ContactLaw *law)
{
    assert_string_equal(law->name, "press");
    assert_string_equal(law->kind, "points");
    assert_string_equal(law->points, "press.csv");
    assert_string_equal(law->unloading, "release.csv");
    assert_int_equal(law->point_count, 3);
    assert_true(law->max_indentation == 2e-3 && law->max_force == 30.0);
    assert_true(law->residual_indentation == 5e-4 && law->deviation == 0.1);
    assert_true(isnan(law->stiffness) && isnan(law->exponent));
}

/* Laws and friction of the pairs that its material is in, one pair a line, and what the material
 * loses. */
static void describes_pairs_of_materials(void **state)
{
    (void)state;
    double press[2][3] = {{0.0, 1e-3, 2e-3}, {0.0, 10.0, 30.0}};
    double release[2][3] = {{5e-4, 1e-3, 2e-3}, {0.0, 4.0, 30.0}};
    struct friction_pair friction[] = {{{"felt", "steel"}, 0.3, 0.05},
                                       {{"brass", "brass"}, 0.2, 0.04}};
    struct own_law laws[] = {
        {.name = "press",
         .between = {"felt", "steel"},
         .exponent = 1.5,
         .deviation = 0.1,
         .points = {3, press[0], press[1], "press.csv"},
         .unloading = {3, release[0], release[1], "release.csv"}},
        {.name = "stop",
         .between = {"steel", "wood"},
         .stiffness = 2e6,
         .exponent = 2.0,
         .hysteresis = 0.3,
         .deviation = 0.05},
        {.name = "mat",
         .between = {"brass", "wood"},
         .stiffness = 1e6,
         .exponent = 1.0,
         .dissipation = 0.2},
    };
    const struct body_set set = {
        .friction = friction, .friction_count = 2, .laws = laws, .law_count = 3};
    const struct body ball = {COMMON,
                              .kind = &sphere_kind,
                              .radius = 0.5,
                              .loss_factor = NAN,
                              .relaxation = {1, {0.2}, {1e-3}},
                              .yield_rate = {40.0, 5.0, 0.0}};
    percuss_v1_Body wire;
    struct describer describer;
    assert_true(describe_begin(&describer, &set));
    describe_body(&describer, &ball, &wire);

    check_losses(&wire);
    assert_int_equal(wire.pairs._length, 2);
    const percuss_v1_MaterialPair *felt = &wire.pairs._buffer[0], *wood = &wire.pairs._buffer[1];
    assert_string_equal(felt->material_a, "felt");
    assert_string_equal(felt->material_b, "steel");
    assert_true(felt->friction == 0.3 && felt->friction_deviation == 0.05);
    assert_int_equal(felt->law._length, 1);
    check_points(felt->law._buffer);
    assert_string_equal(wood->material_b, "wood");
    assert_true(isnan(wood->friction));
    const percuss_v1_ContactLaw *law = wood->law._buffer;
    assert_string_equal(law->kind, "hysteresis");
    assert_true(law->stiffness == 2e6 && law->exponent == 2.0 && law->hysteresis == 0.3);
    assert_true(law->dissipation == 0.0 && isnan(law->max_force) && law->points[0] == '\0');
    describe_end(&describer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(describes_every_shape),
        cmocka_unit_test(describes_rods_and_beams),
        cmocka_unit_test(describes_pairs_of_materials),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
