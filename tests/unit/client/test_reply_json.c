/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/reply_json.c: the wire's names and nesting, choices as names, undefined numbers
 * as null, doubles that come back bit by bit. */
#include "check.h"
#include "convert.h"
#include "reply_json.h"
#include "unit/client/wire_reply.h"

static json_t *root;

static int convert(void **state)
{
    (void)state;
    struct percuss_reply reply;
    percuss_v1_Reply wire = wire_reply();
    if (convert_reply(&wire, &reply) != PERCUSS_RESULT_OK)
        return 1;
    root = reply_to_json(&reply);
    percuss_reply_free(&reply);
    return 0;
}

static int release(void **state)
{
    (void)state;
    json_decref(root);
    return 0;
}

/* The names of an object's members in order, with commas. */
static void expect_names(const json_t *object, const char *expected)
{
    char names[512] = "";
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)object, name, value)
    {
        strcat(names, *names ? "," : "");
        strcat(names, name);
    }
    assert_string_equal(names, expected);
}

static const json_t *member(const json_t *object, const char *name)
{
    const json_t *value = json_object_get(object, name);
    assert_non_null(value);
    return value;
}

static void names_of_the_contract(void **state)
{
    (void)state;
    expect_names(root, "client,sequence,server,catalogue_revision,version,status,message,complete,"
                       "end_reason,window,contacts,delassus_source,velocity_after,states_after,"
                       "energy,error,model,time_shift,warnings,timing");
    const json_t *contact = json_array_get(member(root, "contacts"), 0);
    expect_names(contact, "impulse,impulse_vector,impulse_compression,restitution,"
                          "inverse_effective_mass,end_time,sub_impact_count,sub_impacts,"
                          "impulse_error,friction,tangent,impulse_tangential,"
                          "impulse_tangential_error,slip_before,slip_after,tangential_restitution,"
                          "restitution_kinematic,restitution_energetic,friction_state");
    expect_names(json_array_get(member(contact, "sub_impacts"), 0),
                 "start,compression_end,end,impulse,compression_impulse,peak_force,"
                 "max_indentation,gap_rate_before,gap_rate_after,negligible,impulse_tangential,"
                 "slip_before,slip_after,friction_state");
    expect_names(member(root, "energy"),
                 "available,rigid_after,vibration,damping,plastic,friction,stored,closure");
    expect_names(member(root, "error"),
                 "restitution_total,total_met,restitution_time,restitution_modes,impulse_time,"
                 "impulse_modes,restitution_by_speed,tolerance_met,restitution_model,"
                 "restitution_yield,impulse_tangential_by_speed");
    expect_names(member(root, "model"),
                 "bodies,contact_model,compliance,method,reason,omitted_error");
    expect_names(json_array_get(member(member(root, "model"), "bodies"), 0),
                 "id,modes,rigid,theory,shear_factor");
    expect_names(json_array_get(member(root, "velocity_after"), 0),
                 "id,velocity,angular_velocity,velocity_error,angular_velocity_error");
    expect_names(json_array_get(member(root, "states_after"), 0), "id,state");
    expect_names(member(root, "timing"), "queue,solve");
}

static void expect_text(const json_t *object, const char *name, const char *expected)
{
    assert_string_equal(json_string_value(member(object, name)), expected);
}

static void choices_are_names(void **state)
{
    (void)state;
    expect_text(root, "status", "TRUNCATED");
    expect_text(root, "end_reason", "HORIZON");
    expect_text(root, "delassus_source", "client");
    expect_text(member(root, "model"), "contact_model", "hertz");
    expect_text(member(root, "model"), "compliance", "half-space");
    expect_text(member(root, "model"), "method", "cvode");
    const json_t *contact = json_array_get(member(root, "contacts"), 0);
    expect_text(contact, "friction_state", "partly");
    expect_text(json_array_get(member(contact, "sub_impacts"), 1), "friction_state", "reversed");
    expect_text(root, "client", "000102030405060708090a0b0c0d0e0f");
    expect_text(root, "server", "f0f1f2f3f4f5f6f7f8f9fafbfcfdfeff");
}

static void undefined_numbers_are_null(void **state)
{
    (void)state;
    assert_true(json_is_null(member(root, "window")));
    assert_true(json_is_null(member(member(root, "error"), "restitution_by_speed")));
    const json_t *contact = json_array_get(member(root, "contacts"), 1);
    assert_true(json_is_null(member(contact, "restitution")));
    contact = json_array_get(member(root, "contacts"), 0);
    assert_true(json_is_null(member(contact, "restitution_energetic")));
    const json_t *slip = member(contact, "slip_before");
    assert_int_equal(json_array_size(slip), 2);
    assert_true(json_number_value(json_array_get(slip, 0)) == 54);
    assert_true(json_is_null(json_array_get(slip, 1)));
}

static void seventeen_digits_are_the_same_double(void **state)
{
    (void)state;
    const double numbers[] = {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.5e-7};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_t *number = json_number(numbers[i]);
        char *text = json_dumps(number, JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
        assert_true(strtod(text, NULL) == numbers[i]);
        free(text);
        json_decref(number);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_of_the_contract),
        cmocka_unit_test(choices_are_names),
        cmocka_unit_test(undefined_numbers_are_null),
        cmocka_unit_test(seventeen_digits_are_the_same_double),
    };
    return cmocka_run_group_tests(tests, convert, release);
}
