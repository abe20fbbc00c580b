/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests model/body.c, material.c, limits.c and the kinds of bodies: masses and inertias against
 * integrals over the body, and the refusal of what cannot exist. */
#include <string.h>

#include "check.h"
#include "model/body.h"

static struct body aluminium(const struct body_kind *kind)
{
    return (struct body){
        .id = "body",
        .material = {.name = "aluminium",
                     .young = 70e9,
                     .poisson = 0.33,
                     .density = 2700.0,
                     .yield = INFINITY},
        .kind = kind,
        .radius = 0.01,
        .length = 0.3,
        .tip_radius = INFINITY,
        .size = {0.1, 0.2, 0.3},
    };
}

static struct body rectangular(enum beam_theory theory)
{
    struct body body = aluminium(&beam_kind);
    body.radius = 0.0;
    body.width = 0.02;
    body.height = 0.05;
    body.theory = theory;
    return body;
}

static void complete(struct body *body)
{
    struct fault fault = {0};
    if (body_complete(body, &fault))
        fail_msg("%s", fault.text);
}

/* Whether a point belongs to the body, from the shape's definition alone. */
static bool contains(const struct body *body, double x, double y, double z)
{
    double r2 = body->radius * body->radius;
    if (body->kind == &sphere_kind)
        return x * x + y * y + z * z <= r2;
    if (body->kind == &block_kind)
        return fabs(x) <= body->size[0] / 2 && fabs(y) <= body->size[1] / 2 &&
               fabs(z) <= body->size[2] / 2;
    if (body->radius == 0.0)
        return fabs(x) <= body->length / 2 && fabs(y) <= body->width / 2 &&
               fabs(z) <= body->height / 2;
    return fabs(x) <= body->length / 2 && y * y + z * z <= r2;
}

/* Mass and inertia by the midpoint rule on 120^3 cells of a box around the body: exact to 1e-4 for
 * boxes, to some 1e-3 for round ones (cells cut by the surface). */
static void integrate(const struct body *body, const double half[3], double result[4])
{
    enum { N = 120 };
    double cell = 8.0 * half[0] * half[1] * half[2] / ((double)N * N * N);
    memset(result, 0, 4 * sizeof *result);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            for (int k = 0; k < N; k++) {
                double x = half[0] * ((2 * i + 1.0) / N - 1.0);
                double y = half[1] * ((2 * j + 1.0) / N - 1.0);
                double z = half[2] * ((2 * k + 1.0) / N - 1.0);
                if (!contains(body, x, y, z))
                    continue;
                result[0] += 1.0;
                result[1] += y * y + z * z;
                result[2] += z * z + x * x;
                result[3] += x * x + y * y;
            }
    for (int i = 0; i < 4; i++)
        result[i] *= cell * body->material.density;
}

static void matches_integrals_over_the_body(void **state)
{
    (void)state;
    static const struct {
        const struct body_kind *kind;
        double half[3];
    } cases[] = {
        {&sphere_kind, {0.01, 0.01, 0.01}}, {&rod_kind, {0.15, 0.01, 0.01}},
        {&beam_kind, {0.15, 0.01, 0.01}},   {&cylinder_kind, {0.15, 0.01, 0.01}},
        {&block_kind, {0.05, 0.10, 0.15}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct body body = aluminium(cases[i].kind);
        double sum[4];
        complete(&body);
        integrate(&body, cases[i].half, sum);
        near_relative(body.mass, sum[0], 2e-3);
        for (int axis = 0; axis < 3; axis++)
            near_relative(body.inertia[axis], sum[1 + axis], 2e-3);
    }
    /* a Timoshenko beam turns like the solid block it is, in each plane */
    struct body beam = rectangular(THEORY_TIMOSHENKO);
    double sum[4];
    complete(&beam);
    integrate(&beam, (double[]){0.15, 0.01, 0.025}, sum);
    near_relative(beam.mass, sum[0], 1e-12);
    for (int axis = 0; axis < 3; axis++)
        near_relative(beam.inertia[axis], sum[1 + axis], 1e-4);
}

static void matches_closed_forms(void **state)
{
    (void)state;
    const double pi = acos(-1.0);
    struct body beam = aluminium(&beam_kind);
    complete(&beam);
    near_relative(beam.area, pi * 1e-4, 1e-15);
    near_relative(beam.mass, 2700.0 * pi * 1e-4 * 0.3, 1e-15);
    near_relative(beam.second_moment[0], pi / 64.0 * 0.02 * 0.02 * 0.02 * 0.02, 1e-14);
    assert_true(beam.second_moment[1] == beam.second_moment[0]);
    near_relative(beam.inertia[1], beam.mass * (0.09 / 12.0 + 1e-4 / 4.0), 1e-15);
    near_relative(beam.inertia[0], beam.mass * 1e-4 / 2.0, 1e-14);

    struct body wall = aluminium(&half_space_kind);
    complete(&wall);
    assert_true(isinf(wall.mass) && isinf(wall.inertia[0]) && isinf(wall.inertia[2]));
    assert_true(isinf(body_smallest_radius(&wall)));
}

static void gives_each_theory_its_rotatory_inertia(void **state)
{
    (void)state;
    struct body slender = rectangular(THEORY_EULER_BERNOULLI);
    complete(&slender);
    /* exactly: sections without thickness */
    assert_true(slender.inertia[1] == slender.mass * (0.3 * 0.3 / 12.0));
    assert_true(slender.inertia[2] == slender.inertia[1]);
    assert_true(isnan(slender.shear_factor[0]) && isnan(slender.shear_factor[1]));

    struct body thick = rectangular(THEORY_TIMOSHENKO);
    complete(&thick);
    /* about y the section's height counts, about z its width */
    near_relative(thick.inertia[1], thick.mass * (0.09 + 0.05 * 0.05) / 12.0, 1e-14);
    near_relative(thick.inertia[2], thick.mass * (0.09 + 0.02 * 0.02) / 12.0, 1e-14);
    near_relative(thick.second_moment[0], 0.05 * 0.02 * 0.02 * 0.02 / 12.0, 1e-14);
    near_relative(thick.second_moment[1], 0.02 * 0.05 * 0.05 * 0.05 / 12.0, 1e-14);
}

static void follows_the_shear_rule(void **state)
{
    (void)state;
    struct body beam = aluminium(&beam_kind);
    beam.shear_rule = SHEAR_COWPER;
    complete(&beam);
    near_relative(beam.shear_factor[1], 6.0 * 1.33 / (7.0 + 6.0 * 0.33), 1e-14); /* Cowper 1966 */
    /* Hutchinson 2001, also where nothing is stated */
    double hutchinson = 6.0 * 1.33 * 1.33 / (7.0 + 12.0 * 0.33 + 4.0 * 0.33 * 0.33);
    for (beam.shear_rule = SHEAR_ABSENT; beam.shear_rule <= SHEAR_HUTCHINSON;
         beam.shear_rule += 2) {
        complete(&beam);
        near_relative(beam.shear_factor[1], hutchinson, 1e-14);
    }
    beam.shear_rule = SHEAR_NUMBER;
    beam.shear_number = 0.85;
    complete(&beam);
    assert_true(beam.shear_factor[0] == 0.85 && beam.shear_factor[1] == 0.85);

    struct body flat = rectangular(THEORY_TIMOSHENKO);
    flat.shear_rule = SHEAR_COWPER;
    complete(&flat);
    near_relative(flat.shear_factor[0], 10.0 * 1.33 / (12.0 + 11.0 * 0.33),
                  1e-14); /* Cowper 1966 */
    assert_true(flat.shear_factor[0] == flat.shear_factor[1]);
    /* turned by a quarter, Hutchinson's two planes change places */
    struct body turned = flat;
    turned.width = flat.height;
    turned.height = flat.width;
    flat.shear_rule = turned.shear_rule = SHEAR_HUTCHINSON;
    complete(&flat);
    complete(&turned);
    assert_true(flat.shear_factor[0] == turned.shear_factor[1]);
    assert_true(flat.shear_factor[0] != flat.shear_factor[1]);
}

static void a_strip_without_hutchinsons_factor_takes_cowpers(void **state)
{
    (void)state;
    struct body strip = rectangular(THEORY_TIMOSHENKO);
    strip.width = 10.0 * strip.height;
    complete(&strip);
    double cowper = 10.0 * 1.33 / (12.0 + 11.0 * 0.33);
    near_relative(strip.shear_factor[1], cowper, 1e-14);
    /* on edge it is a tenth as thick as deep, in plane stress but for terms of the fourth order:
     * 5(1 + nu)/(6 + 5 nu), Stephen 2001 */
    near_relative(strip.shear_factor[0], 5.0 * 1.33 / (6.0 + 5.0 * 0.33), 1e-5);
}

static void knows_its_smallest_radius(void **state)
{
    (void)state;
    struct body rod = aluminium(&rod_kind), block = aluminium(&block_kind);
    struct body flat = rectangular(THEORY_TIMOSHENKO), disc = aluminium(&cylinder_kind);
    disc.length = 0.004;
    assert_true(body_smallest_radius(&rod) == 0.01);
    assert_true(body_smallest_radius(&block) == 0.05);
    assert_true(body_smallest_radius(&flat) == 0.01);
    assert_true(body_smallest_radius(&disc) == 0.002);
    assert_true(body_is_flexible(&rod) && body_is_flexible(&flat));
    assert_false(body_is_flexible(&block) || body_is_flexible(&disc));
}

/* Its vibration is computed when a scene asks for it; until then the body says that it can have it.
 */
static void a_block_s_damping_can_be_changed(void **state)
{
    (void)state;
    const struct body_kind *kinds[] = {&block_kind, &cylinder_kind};
    for (size_t i = 0; i < 2; i++) {
        struct fault fault = {0};
        struct body body = aluminium(kinds[i]), varied;
        const struct body_variation damping = {PERCUSS_PARAMETER_DAMPING, 0.02};
        complete(&body);
        assert_int_equal(body_vary(&body, &damping, 1, &varied, &fault), PERCUSS_OK);
        near(varied.damping, 0.02, 0.0);
        body.rigid = true;
        assert_int_equal(body_vary(&body, &damping, 1, &varied, &fault), PERCUSS_BAD_REQUEST);
    }
}

static void refuse(struct body body, const char *message)
{
    struct fault fault = {0};
    assert_int_equal(body_complete(&body, &fault), PERCUSS_BAD_REQUEST);
    if (strncmp(fault.text, message, strlen(message)) != 0)
        fail_msg("\"%s\"\nexpected %s", fault.text, message);
    assert_int_equal(body_complete(&body, NULL), PERCUSS_BAD_REQUEST);
}

#define REFUSE(base, change, message)                                                              \
    do {                                                                                           \
        struct body body = base;                                                                   \
        body.change;                                                                               \
        refuse(body, message);                                                                     \
    } while (0)

static void refuses_impossible_bodies(void **state)
{
    (void)state;
    const struct body sphere = aluminium(&sphere_kind), rod = aluminium(&rod_kind);
    const struct body beam = aluminium(&beam_kind), block = aluminium(&block_kind);
    const struct body flat = rectangular(THEORY_TIMOSHENKO);
    REFUSE(sphere, radius = -0.1, "radius: -0.1: must be a finite length > 0 m");
    REFUSE(sphere, radius = 0.0, "radius: 0: must be");
    REFUSE(sphere, radius = NAN, "radius: nan: must be");
    REFUSE(sphere, radius = INFINITY, "radius: inf: must be");
    REFUSE(sphere, radius = 2e3, "radius: 2000: must be");
    REFUSE(sphere, supports[0] = SUPPORT_CLAMPED, "ends: 2: must be free for a sphere");
    REFUSE(rod, length = 0.0, "length: 0: must be");
    REFUSE(rod, tip_radius = 0.009, "tip_radius: 0.009: must be at least radius (0.01 m)");
    REFUSE(rod, tip_radius = NAN, "tip_radius: nan: must be");
    REFUSE(rod, supports[1] = SUPPORT_PINNED, "ends: 1: must be one of free, fixed");
    REFUSE(rod, damping = 1.0, "damping: 1: must be a ratio >= 0 and < 1");
    REFUSE(rod, damping = -1e-9, "damping: -1e-09: must be");
    REFUSE(rod, modes = 5001, "modes: 5001: must be a whole number, 1 to 5000");
    REFUSE(beam, width = 0.1, "section: 0.1 x 0: must be absent beside radius");
    REFUSE(beam, length = -1.0, "length: -1: must be");
    REFUSE(beam, theory = 2, "theory: 2: must be one of timoshenko");
    REFUSE(beam, shear_rule = 4, "shear_factor: 4: must be cowper");
    REFUSE(beam, shear_rule = SHEAR_NUMBER, "shear_factor: 0: must be a number > 0");
    REFUSE(beam, supports[0] = 3, "ends: 3: must be one of free, pinned, clamped");
    REFUSE(flat, height = 0.0, "section.height: 0: must be");
    REFUSE(block, size[2] = -1.0, "size[2]: -1: must be");
    REFUSE(block, supports[1] = SUPPORT_PINNED, "ends: 1: must be one of free, clamped");
    struct body held = block;
    held.supports[0] = SUPPORT_CLAMPED;
    REFUSE(held, rigid = true, "rigid: true: must be false where an end is held");
    REFUSE(held, size[1] = 0.0002, "ends: must be free where the block is thinner than 1/200");
}

static void refuses_impossible_materials(void **state)
{
    (void)state;
    const struct body wall = aluminium(&half_space_kind);
    REFUSE(wall, material.young = 0.0, "material.young: 0: must be");
    REFUSE(wall, material.poisson = 0.5, "material.poisson: 0.5: must be a number > -1 and < 0.5");
    REFUSE(wall, material.poisson = -1.0, "material.poisson: -1: must be");
    REFUSE(wall, material.density = NAN, "material.density: nan: must be");
    REFUSE(wall, material.yield = 0.0, "material.yield: 0: must be");
    REFUSE(wall, material.yield = -INFINITY, "material.yield: -inf: must be");
    REFUSE(wall, material.yield = 70e9, "material.yield: 7e+10: must be below young");
    REFUSE(wall, material.tangent = -1.0, "material.tangent: -1: must be");
    REFUSE(wall, material.tangent = 70e9, "material.tangent: 7e+10: must be below young");
    REFUSE(wall, material.tangent = 1e9, "material.tangent: 1e+09: must be 0 or absent");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matches_integrals_over_the_body),
        cmocka_unit_test(matches_closed_forms),
        cmocka_unit_test(gives_each_theory_its_rotatory_inertia),
        cmocka_unit_test(follows_the_shear_rule),
        cmocka_unit_test(a_strip_without_hutchinsons_factor_takes_cowpers),
        cmocka_unit_test(knows_its_smallest_radius),
        cmocka_unit_test(a_block_s_damping_can_be_changed),
        cmocka_unit_test(refuses_impossible_bodies),
        cmocka_unit_test(refuses_impossible_materials),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
