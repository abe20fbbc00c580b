/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/convert.c: every field of a wire reply arrives, and its memory goes. */
#include "check.h"
#include "convert.h"
#include "unit/client/wire_reply.h"

static struct percuss_reply reply;

static int convert(void **state)
{
    (void)state;
    percuss_v1_Reply wire = wire_reply();
    return convert_reply(&wire, &reply) != PERCUSS_RESULT_OK;
}

static int release(void **state)
{
    (void)state;
    percuss_reply_free(&reply);
    return reply.storage != NULL || reply.contact_count != 0;
}

static void header(void **state)
{
    (void)state;
    assert_int_equal(reply.client[15], 15);
    assert_int_equal(reply.server[15], 0xff);
    assert_int_equal(reply.sequence, 25);
    assert_string_equal(reply.catalogue_revision, "r");
    assert_string_equal(reply.version, "v");
    assert_int_equal(reply.status, PERCUSS_TRUNCATED);
    assert_string_equal(reply.message, "m");
    assert_true(reply.complete);
    assert_int_equal(reply.end_reason, PERCUSS_END_HORIZON);
    assert_true(isnan(reply.window));
    assert_int_equal(reply.delassus_source, PERCUSS_DELASSUS_CLIENT);
    assert_true(reply.time_shift == 26 && reply.timing.queue == 27 && reply.timing.solve == 28);
}

static void contacts(void **state)
{
    (void)state;
    assert_int_equal(reply.contact_count, 2);
    const struct percuss_contact_result *contact = reply.contacts;
    assert_true(contact[0].impulse == 10 && contact[0].impulse_vector[2] == 13);
    assert_true(contact[0].impulse_compression == 14 && contact[0].restitution == 0.5);
    assert_true(contact[1].inverse_effective_mass == 15 && contact[1].end_time == 16);
    assert_true(isnan(contact[1].restitution));
    assert_true(contact[0].impulse_error == 43);
    assert_int_equal(contact[0].sub_impact_count, 300);
    assert_int_equal(contact[0].sub_impacts_listed, 2);
    assert_int_equal(contact[1].sub_impacts_listed, 0);
    const struct percuss_sub_impact *sub = contact[0].sub_impacts;
    assert_true(sub[0].start == 1 && sub[0].compression_end == 2 && sub[0].end == 3);
    assert_true(sub[0].impulse == 4 && sub[0].compression_impulse == 5 && !sub[0].negligible);
    assert_true(sub[1].peak_force == 6 && sub[1].max_indentation == 7 && sub[1].negligible);
    assert_true(sub[1].gap_rate_before == 8 && sub[1].gap_rate_after == 9);
}

static void friction(void **state)
{
    (void)state;
    const struct percuss_contact_result *contact = reply.contacts;
    const struct percuss_sub_impact *sub = &contact->sub_impacts[1];
    assert_true(contact->friction == 0.3 && contact->tangent[1] == 1);
    assert_true(contact->impulse_tangential[0] == 51 && contact->impulse_tangential[1] == 52);
    assert_true(contact->impulse_tangential_error == 53 && contact->slip_before[0] == 54);
    assert_true(isnan(contact->slip_before[1]) && contact->slip_after[1] == 55);
    assert_true(contact->tangential_restitution == 56 && contact->restitution_kinematic == 57);
    assert_true(isnan(contact->restitution_energetic));
    assert_int_equal(contact->friction_state, PERCUSS_FRICTION_STATE_PARTLY);
    assert_true(sub->impulse_tangential[0] == 46 && sub->impulse_tangential[1] == 47);
    assert_true(sub->slip_before[1] == 49 && isnan(sub->slip_after[0]) && sub->slip_after[1] == 50);
    assert_int_equal(sub->friction_state, PERCUSS_FRICTION_STATE_REVERSED);
    assert_true(reply.energy.friction == 58);
    /* the second one is as a server sends it that knows no friction */
    contact = &reply.contacts[1];
    assert_true(contact->friction == 0.0 && contact->tangent[1] == 0.0);
    assert_true(contact->impulse_tangential[0] == 0.0 && contact->slip_after[0] == 0.0);
    assert_true(isnan(contact->tangential_restitution));
    assert_true(isnan(contact->restitution_kinematic) && isnan(contact->restitution_energetic));
}

static void bodies_after(void **state)
{
    (void)state;
    assert_int_equal(reply.velocity_after_count, 1);
    assert_string_equal(reply.velocity_after[0].id, "sphere");
    assert_true(reply.velocity_after[0].velocity[0] == 17);
    assert_true(reply.velocity_after[0].angular_velocity[2] == 22);
    assert_true(reply.velocity_after[0].velocity_error == 44);
    assert_true(reply.velocity_after[0].angular_velocity_error == 45);
    assert_int_equal(reply.states_after_count, 2);
    assert_string_equal(reply.states_after[1].id, "beam");
    assert_string_equal(reply.states_after[1].state, "t2");
}

static void energy_error_and_model(void **state)
{
    (void)state;
    const struct percuss_energy *energy = &reply.energy;
    assert_true(energy->available == 29 && energy->rigid_after == 30 && energy->damping == 31);
    assert_true(energy->plastic == 32 && energy->stored == 33 && energy->closure == 34);
    assert_int_equal(energy->vibration_count, 1);
    assert_string_equal(energy->vibration[0].id, "beam");
    assert_true(energy->vibration[0].energy == 23);
    assert_true(reply.error.restitution_time == 35 && reply.error.restitution_modes == 36);
    assert_true(reply.error.impulse_time == 37 && reply.error.impulse_modes == 38);
    assert_true(isnan(reply.error.restitution_by_speed) && reply.error.tolerance_met);
    assert_true(reply.error.restitution_model == 40 && reply.error.restitution_total == 41);
    assert_true(reply.error.total_met && reply.error.restitution_yield == 42);
    assert_true(isnan(reply.error.impulse_tangential_by_speed[0]));
    assert_true(reply.error.impulse_tangential_by_speed[1] == 43);
    assert_int_equal(reply.model.body_count, 1);
    assert_string_equal(reply.model.bodies[0].theory, "timoshenko");
    assert_int_equal(reply.model.bodies[0].modes, 24);
    assert_true(reply.model.bodies[0].shear_factor == 0.89);
    assert_int_equal(reply.model.contact_model, PERCUSS_CONTACT_HERTZ);
    assert_int_equal(reply.model.compliance, PERCUSS_COMPLIANCE_HALF_SPACE);
    assert_int_equal(reply.model.method, PERCUSS_METHOD_CVODE);
    assert_string_equal(reply.model.reason, "because");
    assert_true(reply.model.omitted_error == 39);
}

static void warnings(void **state)
{
    (void)state;
    assert_int_equal(reply.warning_count, 2);
    assert_string_equal(reply.warnings[0], "one");
    assert_string_equal(reply.warnings[1], "another");
}

static void an_empty_reply(void **state)
{
    (void)state;
    percuss_v1_Reply wire = {.status = percuss_v1_STATUS_BUSY};
    struct percuss_reply empty;
    assert_int_equal(convert_reply(&wire, &empty), PERCUSS_RESULT_OK);
    assert_int_equal(empty.status, PERCUSS_BUSY);
    assert_int_equal(empty.contact_count + empty.warning_count + empty.model.body_count, 0);
    percuss_reply_free(&empty);
    percuss_reply_free(&empty); /* an empty one is allowed */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(header),
        cmocka_unit_test(contacts),
        cmocka_unit_test(friction),
        cmocka_unit_test(bodies_after),
        cmocka_unit_test(energy_error_and_model),
        cmocka_unit_test(warnings),
        cmocka_unit_test(an_empty_reply),
    };
    return cmocka_run_group_tests(tests, convert, release);
}
