/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/request_json.c: a whole request, defaults, and every kind of
 * error with its path. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "request_json.h"

static struct json_request request;
static struct json_fault fault;

static bool read_text(const char *text)
{
    json_error_t error;
    json_t *root = json_loads(text, JSON_DECODE_ANY, &error);
    if (!root)
        fail_msg("%s: %s", text, error.text);
    bool read = request_json_read(root, &request, &fault);
    json_decref(root);
    return read;
}

static void accept(const char *text)
{
    if (!read_text(text))
        fail_msg("%s: %s", text, fault.text);
}

static void refuse(const char *text, const char *message)
{
    if (read_text(text))
        fail_msg("%s was accepted", text);
    if (!strstr(fault.text, message))
        fail_msg("%s: '%s' does not say '%s'", text, fault.text, message);
}

static void reads_the_request_of_the_contract(void **state)
{
    (void)state;
    accept("{\"bodies\": [{\"id\": \"steel-sphere\", \"position\": [0, 0, 0.025], \"orientation\": "
           "[1, 0, 0, 0], \"velocity\": [0, 0, -0.3], \"angular_velocity\": [0, 0, 0]}, {\"id\": "
           "\"al-beam\", \"position\": [0, 0, 0]}], \"contacts\": [{\"a\": 0, \"b\": 1, \"point\": "
           "[0, "
           "0, 0.010], \"normal\": [0, 0, 1]}], \"options\": {\"tolerance\": 1e-6}}");
    const struct percuss_request *read = &request.request;
    assert_int_equal(read->body_count, 2);
    assert_string_equal(read->bodies[0].id, "steel-sphere");
    assert_true(read->bodies[0].position[2] == 0.025 && read->bodies[0].velocity[2] == -0.3);
    assert_string_equal(read->bodies[1].id, "al-beam");
    assert_true(read->bodies[1].orientation[0] == 1.0 && read->bodies[1].orientation[1] == 0.0);
    assert_int_equal(read->contact_count, 1);
    assert_int_equal(read->contacts[0].b, 1);
    assert_true(read->contacts[0].point[2] == 0.010 && read->contacts[0].normal[2] == 1.0);
    assert_true(read->options.tolerance == 1e-6);
    assert_null(read->delassus);
    assert_int_equal(read->sequence, 0);
    assert_false(request.has_client);
}

static void reads_every_member(void **state)
{
    (void)state;
    accept("{\"bodies\": [{\"state\": \"t1\", \"elapsed\": 2.5, \"specimen\": \"rod 7\", "
           "\"overrides\": {\"damping\": 0.01, \"young\": 71e9}}],"
           "\"contacts\": [{\"gap\": -1e-4, \"gap_acceleration\": -9.81, \"friction\": 0.3, "
           "\"tangent\": [0, 1, 0]}],"
           "\"options\": {\"horizon\": 0.01, \"contact_model\": \"closed-form\", \"method\": "
           "\"cvode\","
           "\"compliance\": \"matched\", \"dents\": \"ignore\", \"conditioning\": true, \"trace\": "
           "false,"
           "\"friction\": \"plain\", \"deadline\": 3}, \"client\": "
           "\"000102030405060708090A0b0c0d0eff\", \"sequence\": 12}");
    const struct percuss_options *options = &request.request.options;
    assert_string_equal(request.request.bodies[0].state, "t1");
    assert_true(request.request.bodies[0].elapsed == 2.5);
    assert_string_equal(request.request.bodies[0].specimen, "rod 7");
    assert_int_equal(request.request.bodies[0].override_count, 2);
    assert_int_equal(request.request.bodies[0].overrides[0].parameter, PERCUSS_PARAMETER_YOUNG);
    assert_true(request.request.bodies[0].overrides[1].value == 0.01);
    assert_true(request.request.contacts[0].gap == -1e-4);
    assert_true(request.request.contacts[0].gap_acceleration == -9.81);
    assert_true(options->horizon == 0.01 && options->deadline == 3.0);
    assert_int_equal(options->contact_model, PERCUSS_CONTACT_CLOSED_FORM);
    assert_int_equal(options->method, PERCUSS_METHOD_CVODE);
    assert_int_equal(options->compliance, PERCUSS_COMPLIANCE_MATCHED);
    assert_int_equal(options->dents, PERCUSS_DENTS_IGNORE);
    assert_true(options->conditioning && !options->trace);
    assert_int_equal(options->friction, PERCUSS_FRICTION_PLAIN);
    assert_true(request.request.contacts[0].friction == 0.3);
    assert_true(request.request.contacts[0].tangent[1] == 1.0);
    assert_true(request.has_client);
    assert_int_equal(request.client[10], 0x0a);
    assert_int_equal(request.client[15], 0xff);
    assert_int_equal(request.request.sequence, 12);
}

static void refuses_unknown_overrides(void **state)
{
    (void)state;
    refuse("{\"bodies\": [{\"overrides\": {\"colour\": 1}}]}",
           "bodies[0].overrides.colour: unknown member; allowed are: young, poisson");
    refuse("{\"bodies\": [{\"overrides\": {\"young\": \"stiff\"}}]}",
           "bodies[0].overrides.young: a number is needed, not text");
    refuse("{\"bodies\": [{\"overrides\": [1]}]}",
           "bodies[0].overrides: an object is needed, not an array");
}

static void takes_an_empty_request(void **state)
{
    (void)state;
    /* whether it makes sense is the server's judgement */
    accept("{}");
    assert_int_equal(request.request.body_count, 0);
    assert_int_equal(request.request.contact_count, 0);
}

static void reads_delassus_flat_or_in_rows(void **state)
{
    (void)state;
    /* members may come in any order: the contacts count */
    accept("{\"delassus\": [[1, 2], [3, 4]], \"contacts\": [{}, {}]}");
    for (int i = 0; i < 4; i++)
        assert_true(request.request.delassus[i] == i + 1);
    accept("{\"delassus\": [1, 2, 3, 4], \"contacts\": [{}, {}]}");
    for (int i = 0; i < 4; i++)
        assert_true(request.request.delassus[i] == i + 1);
    refuse("{\"delassus\": [[1, 2]], \"contacts\": [{}, {}]}",
           "delassus: 2 rows are needed, one a contact, or 6 with both tangents, not 1");
    refuse("{\"delassus\": [[1, 2], [3]], \"contacts\": [{}, {}]}",
           "delassus[1]: 2 numbers are needed, not 1");
    refuse("{\"delassus\": [[1, 2], 3], \"contacts\": [{}, {}]}",
           "delassus[1]: 2 numbers are needed, not a number");
    refuse("{\"delassus\": [1, 2, 3], \"contacts\": [{}, {}]}",
           "delassus: 4 numbers are needed, or 36 with both tangents, not 3");
    refuse("{\"delassus\": 1, \"contacts\": [{}]}", "delassus: an array is needed, not a number");
}

static void reads_delassus_with_tangents(void **state)
{
    (void)state;
    accept("{\"delassus\": [[1, 2, 3], [4, 5, 6], [7, 8, 9]], \"contacts\": [{}]}");
    assert_int_equal(request.request.delassus_rows, 3);
    for (int i = 0; i < 9; i++)
        assert_true(request.request.delassus[i] == i + 1);
    accept("{\"delassus\": [1, 2, 3, 4, 5, 6, 7, 8, 9], \"contacts\": [{}]}");
    assert_int_equal(request.request.delassus_rows, 3);
    for (int i = 0; i < 9; i++)
        assert_true(request.request.delassus[i] == i + 1);
    /* as many rows as contacts say nothing of tangents */
    accept("{\"delassus\": [1, 2, 3, 4, 5, 6, 7, 8, 9], \"contacts\": [{}, {}, {}]}");
    assert_int_equal(request.request.delassus_rows, 3);
    refuse("{\"delassus\": [[1, 2, 3], [4, 5, 6], [7, 8]], \"contacts\": [{}]}",
           "delassus[2]: 3 numbers are needed, not 2");
}

/* n contacts and a matrix of so many rows of so many numbers. */
static json_t *request_of(size_t contacts, size_t rows, bool flat)
{
    json_t *list = json_array(), *matrix = json_array();
    for (size_t i = 0; i < contacts; i++)
        json_array_append_new(list, json_object());
    for (size_t i = 0; i < rows; i++) {
        json_t *row = flat ? json_incref(matrix) : json_array();
        for (size_t j = 0; j < rows; j++)
            json_array_append_new(row, json_real(1.0));
        if (flat)
            json_decref(row);
        else
            json_array_append_new(matrix, row);
    }
    return json_pack("{soso}", "contacts", list, "delassus", matrix);
}

static void refuses_more_delassus_than_fits(void **state)
{
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        struct json_fault reason;
        json_t *full = request_of(21, 63, flat), *more = request_of(22, 66, flat);
        assert_true(request_json_read(full, &request, &reason));
        assert_int_equal(request.request.delassus_rows, 63);
        assert_false(request_json_read(more, &request, &reason));
        assert_non_null(strstr(reason.text, "delassus: 66 rows are too many: of normals and "
                                            "tangents up to 21 contacts are allowed, not 22"));
        json_decref(full);
        json_decref(more);
    }
}

static void refuses_unknown_members(void **state)
{
    (void)state;
    refuse("{\"body\": []}", "body: unknown member; allowed are: bodies, contacts");
    refuse("{\"bodies\": [{}, {\"velocty\": [0, 0, 1]}]}",
           "bodies[1].velocty: unknown member; allowed are: id, position");
    refuse("{\"contacts\": [{\"c\": 1}]}", "contacts[0].c: unknown member; allowed are: a, b");
    refuse("{\"options\": {\"tol\": 1}}", "options.tol: unknown member; allowed are: tolerance");
}

/* What a file holds may move a terminal's cursor. */
static void messages_have_no_control_characters(void **state)
{
    (void)state;
    refuse("{\"bod\\u001b[2J\\n\": 1}", "bod?[2J?: unknown member");
}

static void refuses_wrong_types(void **state)
{
    (void)state;
    refuse("[]", "a request is an object, not an array");
    refuse("{\"bodies\": {}}", "bodies: an array is needed, not an object");
    refuse("{\"bodies\": [1]}", "bodies[0]: an object is needed, not a number");
    refuse("{\"bodies\": [{\"id\": 1}]}", "bodies[0].id: text is needed, not a number");
    refuse("{\"bodies\": [{\"position\": 1}]}",
           "bodies[0].position: 3 numbers are needed, not a number");
    refuse("{\"bodies\": [{\"position\": [0, null, 0]}]}",
           "bodies[0].position[1]: a number is needed, not null");
    refuse("{\"bodies\": [{\"elapsed\": \"1\"}]}",
           "bodies[0].elapsed: a number is needed, not text");
    refuse("{\"contacts\": [{\"a\": 0.5}]}", "contacts[0].a: a whole number >= 0 is needed");
    refuse("{\"contacts\": [{\"b\": -1}]}", "contacts[0].b: a whole number >= 0 is needed");
    refuse("{\"contacts\": [{\"b\": 4294967296}]}", "contacts[0].b: a whole number");
    refuse("{\"options\": []}", "options: an object is needed, not an array");
    refuse("{\"options\": {\"trace\": 1}}", "options.trace: true or false is needed, not a number");
    refuse("{\"options\": {\"method\": \"euler\"}}",
           "options.method: 'euler' is not one of: modal, cvode");
    refuse("{\"options\": {\"method\": 1}}",
           "options.method: one of modal, cvode is needed, not a number");
    refuse("{\"client\": \"12\"}", "client: 32 hexadecimal digits are needed");
    refuse("{\"client\": \"0001020304050607 8090a0b0c0d0eff\"}", "client: 32 hexadecimal digits");
    refuse("{\"sequence\": 0}", "sequence: a whole number >= 1 is needed");
    refuse("{\"sequence\": 1.5}", "sequence: a whole number >= 1 is needed");
}

static void refuses_wrong_lengths(void **state)
{
    (void)state;
    refuse("{\"bodies\": [{\"position\": [0, 0]}]}",
           "bodies[0].position: 3 numbers are needed, not 2");
    refuse("{\"bodies\": [{\"orientation\": [1, 0, 0]}]}",
           "bodies[0].orientation: 4 numbers are needed, not 3");
    refuse("{\"contacts\": [{\"normal\": [0, 0, 1, 0]}]}",
           "contacts[0].normal: 3 numbers are needed, not 4");
    /* an id of 63 bytes fits, one of 64 does not */
    char text[128];
    snprintf(text, sizeof text, "{\"bodies\": [{\"id\": \"%063d\"}]}", 0);
    accept(text);
    snprintf(text, sizeof text, "{\"bodies\": [{\"id\": \"%064d\"}]}", 0);
    refuse(text, "bodies[0].id: up to 63 bytes are allowed, not 64");
}

static void refuses_too_many(void **state)
{
    (void)state;
    char text[512] = "{\"contacts\": [{}";
    for (int i = 1; i < 65; i++)
        strcat(text, ", {}");
    strcat(text, "]}");
    refuse(text, "contacts: up to 64 are allowed, not 65");
    memcpy(text, "{\"bodies\"  ", 11);
    refuse(text, "bodies: up to 64 are allowed, not 65");
}

/* Writes the text to a file and loads it. */
static bool load(const char *text)
{
    char name[] = "/tmp/percuss_request_XXXXXX";
    int descriptor = mkstemp(name);
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, text, strlen(text)), strlen(text));
    close(descriptor);
    bool loaded = request_json_load(name, &request, &fault);
    unlink(name);
    return loaded;
}

static void names_the_line_of_broken_json(void **state)
{
    (void)state;
    assert_true(load("{\"bodies\": []}"));
    assert_false(load("{\n\"bodies\": [}"));
    assert_non_null(strstr(fault.text, "line 2"));
    assert_false(load("{\"bodies\": [], \"bodies\": []}"));
    assert_non_null(strstr(fault.text, "duplicate"));
    assert_false(request_json_load("/nonexistent/request.json", &request, &fault));
    assert_non_null(strstr(fault.text, "/nonexistent/request.json"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_the_request_of_the_contract),
        cmocka_unit_test(reads_every_member),
        cmocka_unit_test(refuses_unknown_overrides),
        cmocka_unit_test(takes_an_empty_request),
        cmocka_unit_test(reads_delassus_flat_or_in_rows),
        cmocka_unit_test(reads_delassus_with_tangents),
        cmocka_unit_test(refuses_more_delassus_than_fits),
        cmocka_unit_test(refuses_unknown_members),
        cmocka_unit_test(messages_have_no_control_characters),
        cmocka_unit_test(refuses_wrong_types),
        cmocka_unit_test(refuses_wrong_lengths),
        cmocka_unit_test(refuses_too_many),
        cmocka_unit_test(names_the_line_of_broken_json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
