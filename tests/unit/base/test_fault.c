/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/base/fault.c: messages and the names of the wire's numbers. */
#include <string.h>

#include "base/fault.h"
#include "check.h"

static void the_message_is_written_and_the_status_returned(void **state)
{
    (void)state;
    struct fault fault;
    assert_int_equal(
        fault_set(&fault, PERCUSS_BAD_REQUEST, "contacts[%zu].gap: %g", (size_t)3, 0.5),
        PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text, "contacts[3].gap: 0.5");
    assert_int_equal(fault_set(NULL, PERCUSS_BUSY, "%s", "ignored"), PERCUSS_BUSY);
}

static void a_long_message_is_cut(void **state)
{
    (void)state;
    struct {
        struct fault fault;
        char after;
    } guarded = {.after = 'x'};
    char text[2000];
    memset(text, 'a', sizeof text - 1);
    text[sizeof text - 1] = 0;
    fault_set(&guarded.fault, PERCUSS_INTERNAL, "%s", text);
    assert_int_equal(strlen(guarded.fault.text), sizeof guarded.fault.text - 1);
    assert_int_equal(guarded.after, 'x');
}

/* Text of a file or of a stranger's request may hold what moves a terminal's cursor. */
static void control_characters_do_not_pass(void **state)
{
    (void)state;
    struct fault fault;
    fault_set(&fault, PERCUSS_BAD_REQUEST, "%s: unknown", "a\x1b[2J\nb\x7f\x01\xc3\xa9");
    assert_string_equal(fault.text, "a?[2J?b??\xc3\xa9: unknown");
}

static void every_number_has_its_name(void **state)
{
    (void)state;
    assert_string_equal(status_name(PERCUSS_OK), "OK");
    assert_string_equal(status_name(PERCUSS_NOT_APPROACHING), "NOT_APPROACHING");
    assert_string_equal(status_name(PERCUSS_INTERNAL), "INTERNAL");
    assert_string_equal(end_reason_name(PERCUSS_END_HANDED_BACK), "HANDED_BACK");
    assert_string_equal(contact_model_name(PERCUSS_CONTACT_CLOSED_FORM), "closed-form");
    assert_string_equal(method_name(PERCUSS_METHOD_CVODE), "cvode");
    assert_string_equal(compliance_name(PERCUSS_COMPLIANCE_HALF_SPACE), "half-space");
    assert_string_equal(friction_name(PERCUSS_FRICTION_PLAIN), "plain");
    assert_string_equal(status_name(PERCUSS_STATUS_COUNT), "?");
    assert_string_equal(end_reason_name(PERCUSS_END_COUNT), "?");
    assert_string_equal(contact_model_name(~0u), "?");
    assert_string_equal(method_name(PERCUSS_METHOD_COUNT), "?");
    assert_string_equal(compliance_name(PERCUSS_COMPLIANCE_COUNT), "?");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_message_is_written_and_the_status_returned),
        cmocka_unit_test(a_long_message_is_cut),
        cmocka_unit_test(control_characters_do_not_pass),
        cmocka_unit_test(every_number_has_its_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
