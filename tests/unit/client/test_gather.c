/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/gather.c: parts of a trace in order, repeated, foreign and malformed. */
#include "check.h"
#include "gather.h"

static double numbers[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};

static dds_sequence_double list(uint32_t first, uint32_t length)
{
    return (dds_sequence_double){length, length, numbers + first, false};
}

static percuss_v1_Trace part_of(uint32_t contact, uint32_t part, uint32_t parts, uint32_t length)
{
    percuss_v1_Trace wire = {.contact = contact, .part = part, .parts = parts};
    wire.time = list(part, length);
    wire.force = list(1 + part, length);
    wire.indentation = wire.gap = wire.gap_rate = list(0, length);
    wire.displacement_a = wire.displacement_b = list(0, length);
    wire.velocity_a = list(2 + part, length);
    /* velocity_b is missing, as from a server that does not know it */
    return wire;
}

static void puts_parts_together(void **state)
{
    (void)state;
    static struct gather gather;
    struct percuss_trace trace;
    percuss_v1_Trace second = part_of(1, 1, 2, 1), first = part_of(1, 0, 2, 3);
    percuss_v1_Trace other = part_of(0, 0, 1, 2), foreign = part_of(64, 0, 1, 2);
    percuss_v1_Trace longer = part_of(1, 1, 2, 7);
    gather_add(&gather, &second); /* too early */
    gather_add(&gather, &foreign);
    assert_false(gather_is_complete(&gather, 2));
    gather_add(&gather, &first);
    gather_add(&gather, &first);  /* repeated */
    gather_add(&gather, &longer); /* does not fit what was announced */
    gather_add(&gather, &second);
    assert_false(gather_is_complete(&gather, 2));
    gather_add(&gather, &other);
    assert_true(gather_is_complete(&gather, 2));
    assert_int_equal(gather_collect(&gather, 2, &trace), PERCUSS_RESULT_OK);
    gather_clear(&gather);
    assert_int_equal(trace.contact_count, 2);
    assert_int_equal(trace.contacts[0].count, 2);
    const struct percuss_contact_trace *contact = &trace.contacts[1];
    assert_int_equal(contact->count, 4);
    assert_true(contact->time[2] == 2 && contact->time[3] == 1);
    assert_true(contact->force[2] == 3 && contact->force[3] == 2);
    assert_true(contact->velocity_a[0] == 2 && contact->velocity_a[3] == 3);
    assert_true(isnan(contact->velocity_b[0]) && isnan(contact->velocity_b[3]));
    percuss_trace_free(&trace);
    percuss_trace_free(&trace);
}

/* The first part says whether there is friction. */
static void friction_has_columns_of_its_own(void **state)
{
    (void)state;
    static struct gather gather;
    struct percuss_trace trace;
    percuss_v1_Trace with = part_of(0, 0, 2, 3), then = part_of(0, 1, 2, 2);
    percuss_v1_Trace without = part_of(1, 0, 2, 3), late = part_of(1, 1, 2, 2);
    with.force_tangential_1 = with.force_tangential_2 = list(0, 3);
    with.slip_1 = with.slip_2 = list(1, 3);
    then.force_tangential_2 = list(4, 2);
    late.slip_1 = list(0, 2);
    gather_add(&gather, &with);
    gather_add(&gather, &then);
    gather_add(&gather, &without);
    gather_add(&gather, &late);
    assert_int_equal(gather_collect(&gather, 2, &trace), PERCUSS_RESULT_OK);
    const struct percuss_contact_trace *contact = &trace.contacts[0];
    assert_true(contact->force_tangential_1[2] == 2 && contact->slip_2[0] == 1);
    assert_true(contact->force_tangential_2[4] == 5 && isnan(contact->slip_1[3]));
    assert_null(trace.contacts[1].force_tangential_1);
    assert_null(trace.contacts[1].slip_1);
    assert_int_equal(trace.contacts[1].count, 5);
    percuss_trace_free(&trace);
    gather_clear(&gather);
}

/* Nor is there memory for it. */
static void what_is_announced_is_not_there_yet(void **state)
{
    (void)state;
    static struct gather gather;
    percuss_v1_Trace first = part_of(0, 0, UINT32_MAX, 3), second = part_of(0, 1, UINT32_MAX, 3);
    gather_add(&gather, &first);
    gather_add(&gather, &second);
    assert_false(gather.out_of_memory);
    assert_false(gather_is_complete(&gather, 1));
    assert_int_equal(gather.contacts[0].count, 6);
    assert_in_range(gather.room[0], 6, 12);
    assert_true(gather.contacts[0].time[2] == 2 && gather.contacts[0].time[3] == 1);
    gather_clear(&gather);
}

static void a_refusal_has_no_histories(void **state)
{
    (void)state;
    static struct gather gather;
    struct percuss_trace trace;
    assert_true(gather_is_complete(&gather, 0));
    assert_int_equal(gather_collect(&gather, 0, &trace), PERCUSS_RESULT_OK);
    assert_int_equal(trace.contact_count, 0);
    percuss_trace_free(&trace);
    gather_clear(&gather);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(puts_parts_together),
        cmocka_unit_test(friction_has_columns_of_its_own),
        cmocka_unit_test(what_is_announced_is_not_there_yet),
        cmocka_unit_test(a_refusal_has_no_histories),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
