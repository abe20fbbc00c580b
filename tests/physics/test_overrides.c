/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request's own parameters of a body: the same bits as from a catalogue that has them, whatever
 * was prepared before. */
#include "physics/support.h"

/* The sphere on the beam, both in `lab` under these ids. */
static struct solve_request impact(const char *sphere, const char *beam)
{
    return strike(sphere_spot(sphere, 0.015), side_spot(beam, 0.0, 0.010, 0.0), 0.25);
}

static struct lab *lab_of_two(void)
{
    struct lab *lab = lab_create();
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    lab_add(lab, "sphere", make_sphere(STEEL, 0.015));
    lab_add(lab, "beam", beam);
    beam.material.young = 72e9;
    beam.material.density = 2750.0;
    beam.damping = 0.004;
    lab_add(lab, "other-beam", beam);
    return lab;
}

static void vary(struct solve_body *body, enum percuss_parameter parameter, double value)
{
    body->variations[body->variation_count++] = (struct body_variation){parameter, value};
}

static void same(const struct solve_result *a, const struct solve_result *b)
{
    assert_int_equal(a->status, b->status);
    assert_true(a->contacts[0].restitution == b->contacts[0].restitution);
    assert_true(a->contacts[0].impulse == b->contacts[0].impulse);
    assert_true(a->energy.damping == b->energy.damping);
    assert_int_equal(a->contacts[0].sub_impact_count, b->contacts[0].sub_impact_count);
}

static void overrides_are_another_body(void **state)
{
    (void)state;
    static struct solve_result expected, plain, found;
    struct lab *lab = lab_of_two();
    struct solve_request request = impact("sphere", "other-beam");
    solve(lab->workspace, &lab->means, &request, &expected);
    request = impact("sphere", "beam");
    solve(lab->workspace, &lab->means, &request, &plain);
    struct solve_request own = request;
    vary(&own.bodies[1], PERCUSS_PARAMETER_DAMPING, 0.004);
    vary(&own.bodies[1], PERCUSS_PARAMETER_YOUNG, 72e9);
    vary(&own.bodies[1], PERCUSS_PARAMETER_DENSITY, 2750.0);
    solve(lab->workspace, &lab->means, &own, &found);
    same(&found, &expected);
    assert_true(found.contacts[0].impulse != plain.contacts[0].impulse);
    /* many others, so that the cache forgets some */
    for (int i = 0; i < 80; i++) {
        own.bodies[1].variations[1].value = 60e9 + 1e8 * i;
        assert_int_equal(solve(lab->workspace, &lab->means, &own, &found), PERCUSS_OK);
    }
    solve(lab->workspace, &lab->means, &request, &found);
    same(&found, &plain);
    own.bodies[1].variations[1].value = 72e9;
    solve(lab->workspace, &lab->means, &own, &found);
    same(&found, &expected);
    lab_free(lab);
}

static void refused(struct lab *lab, const struct solve_request *request, const char *message)
{
    static struct solve_result result;
    assert_int_equal(solve(lab->workspace, &lab->means, request, &result), PERCUSS_BAD_REQUEST);
    if (!strstr(result.fault.text, message))
        fail_msg("'%s' does not say '%s'", result.fault.text, message);
}

static void impossible_ones_are_refused_by_name(void **state)
{
    (void)state;
    struct lab *lab = lab_of_two();
    struct solve_request request = impact("sphere", "beam");
    vary(&request.bodies[1], PERCUSS_PARAMETER_YOUNG, -1.0);
    refused(lab, &request, "bodies[1].overrides: material.young: -1: must be");
    request.bodies[1].variations[0].value = NAN;
    refused(lab, &request, "bodies[1].overrides: material.young: nan: must be");
    request.bodies[1].variations[0].value = 70e9;
    vary(&request.bodies[1], PERCUSS_PARAMETER_YOUNG, 71e9);
    refused(lab, &request, "bodies[1].overrides: young: 7.1e+10: must be given once only");
    request = impact("sphere", "beam");
    vary(&request.bodies[0], PERCUSS_PARAMETER_DAMPING, 0.1);
    refused(lab, &request, "bodies[0].overrides: damping: 0.1: a sphere has no such parameter");
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overrides_are_another_body),
        cmocka_unit_test(impossible_ones_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
