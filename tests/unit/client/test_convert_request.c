/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/api/convert.c and request.c: every field reaches the wire, and what does not
 * fit is refused by name. */
#include <string.h>

#include "check.h"
#include "convert.h"

static struct percuss_request request;
static struct request_storage storage;
static percuss_v1_Request wire;

static void fill(void)
{
    percuss_request_init(&request);
    struct percuss_body_motion *body = percuss_request_add_body(&request, "sphere");
    body->position[2] = 1;
    body->velocity[0] = 2;
    body->angular_velocity[1] = 3;
    strcpy(body->state, "t");
    body->elapsed = 4;
    strcpy(body->specimen, "rig");
    body->overrides[body->override_count++] =
        (struct percuss_override){PERCUSS_PARAMETER_DENSITY, 9};
    percuss_request_add_body(&request, "beam");
    struct percuss_contact *contact = percuss_request_add_contact(&request, 0, 1);
    contact->point[0] = 5;
    contact->normal[2] = 6;
    contact->gap = 7;
    contact->gap_acceleration = 8;
    contact->friction = 0.25;
    contact->tangent[1] = 10;
}

static void converts_bodies_and_contacts(void **state)
{
    (void)state;
    fill();
    assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);
    assert_int_equal(wire.bodies._length, 2);
    const percuss_v1_BodyMotion *body = wire.bodies._buffer;
    assert_string_equal(body[0].id, "sphere");
    assert_true(body[0].position[2] == 1 && body[0].velocity[0] == 2);
    assert_true(body[0].angular_velocity[1] == 3 && body[0].elapsed == 4);
    assert_string_equal(body[0].state, "t");
    assert_string_equal(body[0].specimen, "rig");
    assert_int_equal(body[0].overrides._length, 1);
    assert_int_equal(body[0].overrides._buffer[0].parameter, PERCUSS_PARAMETER_DENSITY);
    assert_true(body[0].overrides._buffer[0].value == 9);
    assert_int_equal(body[1].overrides._length, 0);
    assert_true(body[1].orientation[0] == 1 && body[1].elapsed == 0);
    assert_int_equal(wire.contacts._length, 1);
    const percuss_v1_Contact *contact = wire.contacts._buffer;
    assert_int_equal(contact->b, 1);
    assert_true(contact->point[0] == 5 && contact->normal[2] == 6);
    assert_true(contact->gap == 7 && contact->gap_acceleration == 8);
    assert_true(contact->friction == 0.25 && contact->tangent[1] == 10);
    assert_int_equal(wire.delassus._length, 0);
}

static void converts_options_and_delassus(void **state)
{
    (void)state;
    static const double delassus[1] = {9};
    fill();
    request.delassus = delassus;
    request.options = (struct percuss_options){.tolerance = 1e-6,
                                               .horizon = 0.1,
                                               .contact_model = PERCUSS_CONTACT_TABLE,
                                               .method = PERCUSS_METHOD_CVODE,
                                               .compliance = PERCUSS_COMPLIANCE_MATCHED,
                                               .dents = PERCUSS_DENTS_IGNORE,
                                               .conditioning = true,
                                               .trace = true,
                                               .deadline = 2,
                                               .friction = PERCUSS_FRICTION_NONE};
    assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);
    assert_int_equal(wire.delassus._length, 1);
    assert_true(wire.delassus._buffer[0] == 9);
    assert_true(wire.options.tolerance == 1e-6 && wire.options.horizon == 0.1);
    assert_int_equal(wire.options.contact_model, percuss_v1_CONTACT_MODEL_TABLE);
    assert_int_equal(wire.options.method, percuss_v1_METHOD_CVODE);
    assert_int_equal(wire.options.compliance, percuss_v1_COMPLIANCE_MATCHED);
    assert_int_equal(wire.options.dents, percuss_v1_DENTS_IGNORE);
    assert_true(wire.options.conditioning && wire.options.trace && wire.options.deadline == 2);
    assert_int_equal(wire.options.friction, percuss_v1_FRICTION_NONE);
}

static void refuse(const char *message)
{
    assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_INVALID_ARGUMENT);
    if (!strstr(percuss_error_text(), message))
        fail_msg("'%s' does not say '%s'", percuss_error_text(), message);
}

static void refuses_what_does_not_fit(void **state)
{
    (void)state;
    fill();
    memset(request.bodies[1].specimen, 'x', sizeof request.bodies[1].specimen);
    refuse("bodies[1].specimen: not terminated");
    fill();
    memset(request.bodies[0].id, 'x', sizeof request.bodies[0].id);
    refuse("bodies[0].id: not terminated");
    fill();
    request.body_count = PERCUSS_MAX_BODIES + 1;
    refuse("bodies: 65 are too many; up to 64");
    fill();
    request.contact_count = PERCUSS_MAX_CONTACTS + 1;
    refuse("contacts: 65 are too many; up to 64");
}

/* Rows of a matrix: stated by none, by contacts, by contacts with their tangents. */
static void converts_rows_of_delassus(void **state)
{
    (void)state;
    static double delassus[PERCUSS_MAX_DELASSUS];
    fill();
    request.delassus = delassus;
    for (size_t contacts = 1; contacts <= PERCUSS_MAX_CONTACTS; contacts++) {
        request.contact_count = contacts;
        request.delassus_rows = 0;
        assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);
        assert_int_equal(wire.delassus._length, contacts * contacts);
        request.delassus_rows = contacts;
        assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);
        assert_int_equal(wire.delassus._length, contacts * contacts);
        request.delassus_rows = 3 * contacts;
        if (contacts > PERCUSS_MAX_CONTACTS_OBLIQUE)
            continue;
        assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);
        assert_int_equal(wire.delassus._length, 9 * contacts * contacts);
        assert_ptr_equal(wire.delassus._buffer, delassus);
    }
    refuse("delassus_rows: 192, 3 for each of 64 contacts: are too many; of normals and tangents "
           "up to 21 contacts are allowed");
    request.contact_count = 22;
    request.delassus_rows = 66;
    refuse("delassus_rows: 66, 3 for each of 22 contacts");
    request.delassus_rows = 44;
    refuse("delassus_rows: 44: 0, 22 (contact_count) or 66 (3 contact_count) is allowed");
    /* without a matrix they say nothing */
    request.delassus = NULL;
    assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);
    assert_int_equal(wire.delassus._length, 0);
}

static void a_full_request_takes_no_more(void **state)
{
    (void)state;
    percuss_request_init(&request);
    for (int i = 0; i < PERCUSS_MAX_BODIES; i++)
        assert_non_null(percuss_request_add_body(&request, "b"));
    assert_null(percuss_request_add_body(&request, "b"));
    for (int i = 0; i < PERCUSS_MAX_CONTACTS; i++)
        assert_non_null(percuss_request_add_contact(&request, 0, 1));
    assert_null(percuss_request_add_contact(&request, 0, 1));
    assert_int_equal(convert_request(&request, &storage, &wire), PERCUSS_RESULT_OK);

    char id[PERCUSS_ID_SIZE + 1] = "";
    memset(id, 'x', PERCUSS_ID_SIZE);
    percuss_request_init(&request);
    assert_null(percuss_request_add_body(&request, id));
    id[PERCUSS_ID_SIZE - 1] = '\0';
    assert_non_null(percuss_request_add_body(&request, id));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(converts_bodies_and_contacts),
        cmocka_unit_test(converts_options_and_delassus),
        cmocka_unit_test(refuses_what_does_not_fit),
        cmocka_unit_test(converts_rows_of_delassus),
        cmocka_unit_test(a_full_request_takes_no_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
