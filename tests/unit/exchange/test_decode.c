/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests exchange/decode.c: a good request, and every kind of bad input with its message.
 */
#include "sample.h"

#include <math.h>

#include "exchange/decode.h"

static struct sample sample;
static struct solve_request request;

static void converts_a_good_request(void **state)
{
    (void)state;
    struct fault fault;
    sample_fill(&sample);
    sample.bodies[1].elapsed = 0.5;
    sample.wire.options = (percuss_v1_Options){.tolerance = 1e-6,
                                               .horizon = 0.02,
                                               .contact_model = 1,
                                               .method = 1,
                                               .compliance = 2,
                                               .dents = 1,
                                               .conditioning = true,
                                               .trace = true,
                                               .deadline = 3.0,
                                               .friction = 1};
    sample.contacts[1].friction = 0.3;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    assert_int_equal(request.body_count, 2);
    assert_int_equal(request.contact_count, 2);
    assert_string_equal(request.bodies[1].id, "body-1");
    assert_true(request.bodies[1].velocity[2] == -0.5);
    assert_true(request.bodies[1].elapsed == 0.5);
    assert_null(request.bodies[1].state);
    assert_int_equal(request.contacts[1].a, 1);
    assert_int_equal(request.contacts[1].b, 0);
    assert_true(request.contacts[1].gap == 1e-6);
    assert_ptr_equal(request.delassus, sample.delassus);
    assert_false(request.delassus_oblique);
    assert_true(request.options.tolerance == 1e-6 && request.options.horizon == 0.02);
    assert_int_equal(request.options.contact_model, PERCUSS_CONTACT_HERTZ);
    assert_int_equal(request.options.method, PERCUSS_METHOD_CVODE);
    assert_int_equal(request.options.compliance, PERCUSS_COMPLIANCE_MATCHED);
    assert_int_equal(request.options.dents, PERCUSS_DENTS_IGNORE);
    assert_true(request.options.conditioning && request.options.trace);
    assert_int_equal(request.options.friction, PERCUSS_FRICTION_PLAIN);
    assert_true(request.contacts[0].friction == 0.0 && request.contacts[1].friction == 0.3);
    assert_true(request.contacts[0].tangent[0] == 0.0 && request.contacts[0].tangent[1] == 0.0);
}

static void decode_tangent(double x, double y, double z)
{
    struct fault fault;
    const double tangent[3] = {x, y, z};
    sample_fill(&sample);
    memcpy(sample.contacts[0].tangent, tangent, sizeof tangent);
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
}

/* The normals are along z. */
static void a_tangent_becomes_one(void **state)
{
    (void)state;
    const double *tangent = request.contacts[0].tangent;
    decode_tangent(0.0, -2.0, 5.0);
    assert_true(tangent[0] == 0.0 && tangent[1] == -1.0 && tangent[2] == 0.0);
    decode_tangent(3e-310, 4e-310, 0.0);
    assert_true(fabs(tangent[0] - 0.6) < 1e-12 && fabs(tangent[1] - 0.8) < 1e-12);
    decode_tangent(1e6, 1e6, -1e6);
    assert_true(fabs(tangent[0] - sqrt(0.5)) < 1e-15 && tangent[1] == tangent[0]);
    assert_true(tangent[2] == 0.0);
}

static void converts_overrides(void **state)
{
    (void)state;
    struct fault fault;
    percuss_v1_Override overrides[] = {{PERCUSS_PARAMETER_YOUNG, 71e9},
                                       {PERCUSS_PARAMETER_DAMPING, 0.0}};
    sample_fill(&sample);
    sample.bodies[1].overrides._buffer = overrides;
    sample.bodies[1].overrides._length = 2;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    assert_int_equal(request.bodies[0].variation_count, 0);
    assert_int_equal(request.bodies[1].variation_count, 2);
    assert_int_equal(request.bodies[1].variations[1].parameter, PERCUSS_PARAMETER_DAMPING);
    assert_true(request.bodies[1].variations[0].value == 71e9);
    overrides[0].parameter = PERCUSS_PARAMETER_COUNT;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(
        strstr(fault.text, "bodies[1].overrides.parameter: 8: must be one of 0 (young)"));
}

static void takes_zeros_for_defaults(void **state)
{
    (void)state;
    struct fault fault;
    sample_fill(&sample);
    sample.wire.delassus._length = 0;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    assert_null(request.delassus);
    assert_true(request.options.tolerance == 0.0 && request.options.horizon == 0.0);
    assert_int_equal(request.options.contact_model, PERCUSS_CONTACT_AUTO);
}

static void normalises_what_is_nearly_unit(void **state)
{
    (void)state;
    struct fault fault;
    sample_fill(&sample);
    sample.contacts[0].normal[2] = 1.00009;
    sample.bodies[0].orientation[0] = 0.99991;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    assert_true(request.contacts[0].normal[2] == 1.0);
    assert_true(request.bodies[0].orientation[0] == 1.0);
}

static void refused(const char *message)
{
    struct fault fault = {""};
    enum percuss_status status = decode_request(&sample.wire, &request, &fault);
    if (status != PERCUSS_BAD_REQUEST || strcmp(fault.text, message) != 0)
        fail_msg("status %d, \"%s\"\nexpected \"%s\"", status, fault.text, message);
}

/* Puts a bad value into a fresh sample and compares the message. */
#define REFUSED(lvalue, value, message)                                                            \
    do {                                                                                           \
        sample_fill(&sample);                                                                      \
        sample.lvalue = (value);                                                                   \
        refused(message);                                                                          \
    } while (0)

static void refuses_bad_counts(void **state)
{
    (void)state;
    REFUSED(wire.bodies._length, 0, "bodies: 0 given: must be 1 to 64");
    REFUSED(wire.bodies._length, 65, "bodies: 65 given: must be 1 to 64");
    REFUSED(wire.contacts._length, 0, "contacts: 0 given: must be 1 to 64");
    REFUSED(wire.contacts._length, 65, "contacts: 65 given: must be 1 to 64");
}

static void refuses_bad_bodies(void **state)
{
    (void)state;
    REFUSED(bodies[1].id[0], '\0',
            "bodies[1].id: empty: must be the id of a body of the catalogue");
    REFUSED(bodies[1].id[1], '\n',
            "bodies[1].id: byte 0x0a at 1: must be UTF-8 without control characters");
    REFUSED(bodies[0].id[2], '\xff',
            "bodies[0].id: byte 0xff at 2: must be UTF-8 without control characters");
    REFUSED(bodies[0].state[0], '\x1b',
            "bodies[0].state: byte 0x1b at 0: must be UTF-8 without control characters");
    REFUSED(bodies[1].position[0], NAN,
            "bodies[1].position: (nan, 0, 0.25): each must be in [-1e+06, 1e+06]");
    REFUSED(bodies[0].position[1], 2e6,
            "bodies[0].position: (0, 2e+06, 0): each must be in [-1e+06, 1e+06]");
    REFUSED(bodies[0].velocity[2], INFINITY,
            "bodies[0].velocity: (0, 0, inf): each must be in [-1e+06, 1e+06]");
    REFUSED(bodies[0].angular_velocity[2], -INFINITY,
            "bodies[0].angular_velocity: (0, 0, -inf): each must be in [-1e+06, 1e+06]");
    REFUSED(bodies[1].orientation[0], 0.0,
            "bodies[1].orientation: (0, 0, 0, 0): must be a unit quaternion (w, x, y, z) (norm "
            "within 0.0001 of 1)");
    REFUSED(bodies[1].orientation[1], NAN,
            "bodies[1].orientation: (1, nan, 0, 0): must be a unit quaternion (w, x, y, z) (norm "
            "within 0.0001 of 1)");
    REFUSED(bodies[1].elapsed, -1.0, "bodies[1].elapsed: -1: must be in [0, 1e+09]");
    REFUSED(bodies[1].elapsed, NAN, "bodies[1].elapsed: nan: must be in [0, 1e+09]");
}

static void refuses_bad_specimens(void **state)
{
    (void)state;
    struct fault fault;
    REFUSED(bodies[1].specimen[0], '\t',
            "bodies[1].specimen: byte 0x09 at 0: must be UTF-8 without control characters");
    sample_fill(&sample);
    strcpy(sample.bodies[1].specimen, "bar");
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    strcpy(sample.bodies[0].specimen, "bar");
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text,
                        "bodies[1].specimen: bar: must be another one than that of bodies[0]");
    strcpy(sample.bodies[0].specimen, "rod");
    strcpy(sample.bodies[0].state, "0123");
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text, "bodies[0].specimen: rod: must be empty where a state is "
                                    "given: a specimen is at rest");
}

static void refuses_bad_contacts(void **state)
{
    (void)state;
    REFUSED(contacts[0].a, 2, "contacts[0].a: 2: must be an index into bodies, 0 to 1");
    REFUSED(contacts[1].b, 4000000000u,
            "contacts[1].b: 4000000000: must be an index into bodies, 0 to 1");
    REFUSED(contacts[1].b, 1, "contacts[1].b: 1: must be another body than a");
    REFUSED(contacts[0].point[0], NAN,
            "contacts[0].point: (nan, 0, 0): each must be in [-1e+06, 1e+06]");
    REFUSED(contacts[0].normal[2], 2.0,
            "contacts[0].normal: (0, 0, 2): must be a unit vector (norm within 0.0001 of 1)");
    REFUSED(contacts[0].normal[2], 0.0,
            "contacts[0].normal: (0, 0, 0): must be a unit vector (norm within 0.0001 of 1)");
    REFUSED(contacts[1].normal[0], NAN,
            "contacts[1].normal: (nan, 0, 1): must be a unit vector (norm within 0.0001 of 1)");
    REFUSED(contacts[0].gap, NAN, "contacts[0].gap: nan: must be in [-1000, 1000]");
    REFUSED(contacts[0].gap_acceleration, INFINITY,
            "contacts[0].gap_acceleration: inf: must be in [-1e+09, 1e+09]");
    REFUSED(contacts[1].friction, -0.1, "contacts[1].friction: -0.1: must be in [0, 10]");
    REFUSED(contacts[1].friction, 10.5, "contacts[1].friction: 10.5: must be in [0, 10]");
    REFUSED(contacts[1].friction, NAN, "contacts[1].friction: nan: must be in [0, 10]");
    REFUSED(contacts[1].tangent[0], NAN,
            "contacts[1].tangent: (nan, 0, 0): each must be in [-1e+06, 1e+06]");
    REFUSED(contacts[1].tangent[2], -2.0,
            "contacts[1].tangent: (0, 0, -2): must not be parallel to the normal, (0, 0, 1)");
}

static void refuses_bad_options(void **state)
{
    (void)state;
    REFUSED(wire.options.tolerance, -1e-3,
            "options.tolerance: -0.001: must be 0 (the default) or in [1e-12, 1]");
    REFUSED(wire.options.tolerance, 1e-13,
            "options.tolerance: 1e-13: must be 0 (the default) or in [1e-12, 1]");
    REFUSED(wire.options.tolerance, 1.5,
            "options.tolerance: 1.5: must be 0 (the default) or in [1e-12, 1]");
    REFUSED(wire.options.tolerance, NAN,
            "options.tolerance: nan: must be 0 (the default) or in [1e-12, 1]");
    REFUSED(wire.options.horizon, -1.0,
            "options.horizon: -1: must be 0 (the default) or in [1e-09, 10]");
    REFUSED(wire.options.horizon, 11.0,
            "options.horizon: 11: must be 0 (the default) or in [1e-09, 10]");
    REFUSED(wire.options.contact_model, 8,
            "options.contact_model: 8: must be one of 0 (auto), 1 (hertz), 2 (closed-form), 3 "
            "(table), 4 (concurrent-fe), 5 (complete-fe), 6 (viscoelastic), 7 (law)");
    REFUSED(wire.options.method, 2, "options.method: 2: must be one of 0 (modal), 1 (cvode)");
    REFUSED(wire.options.compliance, 3,
            "options.compliance: 3: must be one of 0 (default), 1 (half-space), 2 (matched)");
    REFUSED(wire.options.dents, 2, "options.dents: 2: must be one of 0 (keep), 1 (ignore)");
    REFUSED(wire.options.friction, 3,
            "options.friction: 3: must be one of 0 (micro-slip), 1 (plain), 2 (none)");
    REFUSED(wire.options.deadline, -1.0, "options.deadline: -1: must be in [0, 1e+09]");
    REFUSED(wire.options.deadline, NAN, "options.deadline: nan: must be in [0, 1e+09]");
}

static void refuses_a_bad_delassus(void **state)
{
    (void)state;
    REFUSED(wire.delassus._length, 3,
            "delassus: 3 numbers: must be none, 2 x 2, a row for every contact, or 6 x 6, rows for "
            "its normal and both tangents");
    REFUSED(delassus[0], 0.0, "delassus[0][0]: 0: must be finite and > 0");
    REFUSED(delassus[3], NAN, "delassus[1][1]: nan: must be finite and > 0");
    REFUSED(delassus[3], INFINITY, "delassus[1][1]: inf: must be finite and > 0");
    REFUSED(delassus[3], 1.1e12, "delassus[1][1]: 1.1e+12: must be at most 1e+12");
    REFUSED(delassus[1], NAN, "delassus[1][0]: 0.5: must be finite, as its mirror image nan");
    REFUSED(delassus[2], 0.5000001,
            "delassus[1][0]: 0.50000009999999995: must equal [0][1], 0.5, within "
            "2.44949e-09");
    sample_fill(&sample);
    sample.delassus[2] = 0.5 * (1.0 + 5e-10);
    struct fault fault;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    /* contacts that do not feel each other, in a simulator's rounding */
    sample.delassus[1] = 3e-17;
    sample.delassus[2] = -1e-16;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
}

/* Two contacts with tangents, of which the second one moves along its normal alone. */
static void fill_oblique(void)
{
    sample_fill(&sample);
    memset(sample.delassus, 0, 36 * sizeof *sample.delassus);
    for (int i = 0; i < 4; i++)
        sample.delassus[7 * i] = i == 3 ? 3.0 : 2.0;
    sample.wire.delassus._length = 36;
}

static void refuse_oblique(size_t at, double value, const char *message)
{
    struct fault fault;
    fill_oblique();
    sample.delassus[at] = value;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_BAD_REQUEST);
    if (strcmp(fault.text, message) != 0)
        fail_msg("'%s' is not '%s'", fault.text, message);
}

static void takes_a_delassus_with_tangents(void **state)
{
    (void)state;
    struct fault fault;
    fill_oblique();
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    assert_ptr_equal(request.delassus, sample.delassus);
    assert_true(request.delassus_oblique);
    /* along a tangent that does not move there is rounding of what moves, 1e-9 of sqrt(2 x 3) */
    sample.delassus[1 * 6 + 4] = 2e-9;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    refuse_oblique(1 * 6 + 4, 3e-9,
                   "delassus[4][1]: 0: must equal [1][4], 3e-09, within "
                   "2.44949e-09");
    refuse_oblique(3 * 6 + 3, 0.0, "delassus[3][3]: 0: must be finite and > 0");
    refuse_oblique(4 * 6 + 4, -1e-9, "delassus[4][4]: -1e-09: must be finite and >= 0");
    refuse_oblique(5 * 6 + 5, NAN, "delassus[5][5]: nan: must be finite and >= 0");
    refuse_oblique(5 * 6 + 5, 1.1e12, "delassus[5][5]: 1.1e+12: must be at most 1e+12");
    refuse_oblique(4 * 6 + 5, NAN, "delassus[5][4]: 0: must be finite, as its mirror image nan");
    /* a request without a matrix after one with it */
    fill_oblique();
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    sample.wire.delassus._length = 0;
    assert_int_equal(decode_request(&sample.wire, &request, &fault), PERCUSS_OK);
    assert_true(!request.delassus && !request.delassus_oblique);
}

/* Overlong forms, surrogates and what lies beyond Unicode are not UTF-8. */
static void tells_utf_8_from_other_bytes(void **state)
{
    (void)state;
    static const struct {
        const char *id;
        enum percuss_status status;
    } cases[] = {
        {"Stahl \xc3\x96 \xe2\x82\xac \xf0\x9f\x94\xa7", PERCUSS_OK},
        {"\xc0\xaf", PERCUSS_BAD_REQUEST},
        {"\xe0\x80\xaf", PERCUSS_BAD_REQUEST},
        {"\xed\xa0\x80", PERCUSS_BAD_REQUEST},
        {"\xf4\x90\x80\x80", PERCUSS_BAD_REQUEST},
        {"\xc3", PERCUSS_BAD_REQUEST},
        {"\x80", PERCUSS_BAD_REQUEST},
        {"\xc2\x85", PERCUSS_BAD_REQUEST},
        {"\x7f", PERCUSS_BAD_REQUEST},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct fault fault;
        sample_fill(&sample);
        snprintf(sample.bodies[0].id, sizeof sample.bodies[0].id, "%s", cases[i].id);
        assert_int_equal(decode_request(&sample.wire, &request, &fault), cases[i].status);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(converts_a_good_request),
        cmocka_unit_test(a_tangent_becomes_one),
        cmocka_unit_test(converts_overrides),
        cmocka_unit_test(takes_zeros_for_defaults),
        cmocka_unit_test(normalises_what_is_nearly_unit),
        cmocka_unit_test(refuses_bad_counts),
        cmocka_unit_test(refuses_bad_bodies),
        cmocka_unit_test(refuses_bad_specimens),
        cmocka_unit_test(refuses_bad_contacts),
        cmocka_unit_test(refuses_bad_options),
        cmocka_unit_test(refuses_a_bad_delassus),
        cmocka_unit_test(takes_a_delassus_with_tangents),
        cmocka_unit_test(tells_utf_8_from_other_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
