/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Complete finite elements on rods that yield and harden, against other computations: each within
 * the error that the answer states. The meshes are those of tolerance 0.005, 4 and 8 elements
 * across the contact radius. */
#include "physics/support.h"

/* A steel sphere on the end of an aluminium rod. */
struct blow {
    double sphere, rod, length; /* m */
    double yield, tangent;      /* Pa */
    double speed;
};

static struct solve_result result;

static void answer(const struct blow *blow, double tolerance)
{
    struct lab *lab = lab_create();
    struct material steel = {"steel", 210e9, 0.30, 7780.0, INFINITY, 0.0};
    struct material metal = {"metal", 73e9, 0.33, 2780.0, blow->yield, blow->tangent};
    lab_add(lab, "ball", make_sphere(steel, blow->sphere));
    lab_add(lab, "rod", make_bar(&rod_kind, metal, blow->rod, blow->length));
    struct solve_request request =
        strike(sphere_spot("ball", blow->sphere), end_spot("rod", blow->length), blow->speed);
    request.options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    request.options.tolerance = tolerance;
    lab_solve(lab, &request, &result);
    lab_free(lab);
}

/* One mesh of 32 elements gives 0.6196, another program's finite elements 0.6200. A single mesh of
 * 32 swings by +-0.0007 with the places of its nodes, the other one's by what nobody said: not less
 * is allowed for. One mesh of 8 gives 0.6114 and three places of its nodes 0.611 to 0.624: what two
 * meshes agree on is no error estimate. */
static void a_thick_rod_that_hardens(void **state)
{
    (void)state;
    const struct blow blow = {0.015, 0.020, 1.0, 205e6, 0.73e9, 0.4};
    answer(&blow, 5e-3);
    double e = result.contacts[0].restitution;
    double error = result.restitution_modes;
    assert_true(result.tolerance_met && error <= 5e-3 && error >= 1e-3);
    measured("own mesh of 32", e, 0.6196, error + 0.0007);
    measured("independent", e, 0.6200, error + 0.0007);
}

/* An independent program's complete finite elements: 0.5407, 0.507. Their swing is not known: that
 * of one mesh of 32 elements is allowed for. */
static void rods_that_harden_much(void **state)
{
    (void)state;
    const struct {
        struct blow blow;
        double independent;
    } cases[] = {
        {{0.015, 0.010, 1.0, 205e6, 14.6e9, 0.3}, 0.5407},
        {{0.010, 0.010, 0.4, 100e6, 3.65e9, 0.5}, 0.507},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        answer(&cases[i].blow, 5e-3);
        assert_true(result.tolerance_met);
        measured("e", result.contacts[0].restitution, cases[i].independent,
                 result.restitution_modes + 0.0007);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thick_rod_that_hardens),
        cmocka_unit_test(rods_that_harden_much),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
