/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "request_json.h"

#include "json_schema.h"

#include <percuss/percuss.h>
#include <stdio.h>
#include <string.h>

JSON_TABLE(body_motion, PERCUSS_BODY_FIELDS)
JSON_TABLE(contact, PERCUSS_CONTACT_FIELDS)
JSON_TABLE(options, PERCUSS_OPTION_FIELDS)

/* Whether it is an array of at most `most` elements. */
static bool check_array(const json_t *array, const struct json_path *path, size_t most,
                        struct json_fault *fault)
{
    if (!json_is_array(array))
        return json_fail(fault, path, "an array is needed, not %s", json_kind_of(array));
    if (json_array_size(array) > most)
        return json_fail(fault, path, "up to %zu are allowed, not %zu", most,
                         json_array_size(array));
    return true;
}

static bool read_bodies(const json_t *array, const struct json_path *path,
                        struct json_request *request, struct json_fault *fault)
{
    if (!check_array(array, path, PERCUSS_MAX_BODIES, fault))
        return false;
    for (size_t i = 0; i < json_array_size(array); i++) {
        struct percuss_body_motion *body = percuss_request_add_body(&request->request, "");
        if (!json_read_object(json_array_get(array, i), &(struct json_path){path, NULL, i},
                              body_motion_members(), body, fault))
            return false;
    }
    return true;
}

static bool read_contacts(const json_t *array, const struct json_path *path,
                          struct json_request *request, struct json_fault *fault)
{
    if (!check_array(array, path, PERCUSS_MAX_CONTACTS, fault))
        return false;
    for (size_t i = 0; i < json_array_size(array); i++) {
        struct percuss_contact *contact = percuss_request_add_contact(&request->request, 0, 0);
        if (!json_read_object(json_array_get(array, i), &(struct json_path){path, NULL, i},
                              contact_members(), contact, fault))
            return false;
    }
    return true;
}

/* n rows of n numbers, or n^2 numbers, for the n contacts, which are read before. */
static bool read_delassus(const json_t *array, const struct json_path *path,
                          struct json_request *request, struct json_fault *fault)
{
    size_t contacts = request->request.contact_count;
    if (!json_is_array(array))
        return json_fail(fault, path, "an array is needed, not %s", json_kind_of(array));
    request->request.delassus = request->delassus;
    if (!json_is_array(json_array_get(array, 0)))
        return json_read_numbers(array, path, contacts * contacts, request->delassus, fault);
    if (json_array_size(array) != contacts)
        return json_fail(fault, path, "%zu rows are needed, one a contact, not %zu", contacts,
                         json_array_size(array));
    for (size_t i = 0; i < contacts; i++)
        if (!json_read_numbers(json_array_get(array, i), &(struct json_path){path, NULL, i},
                               contacts, request->delassus + i * contacts, fault))
            return false;
    return true;
}

static bool read_client(const json_t *value, const struct json_path *path,
                        struct json_request *request, struct json_fault *fault)
{
    const char *text = json_is_string(value) ? json_string_value(value) : "";
    if (strlen(text) != 32 || strspn(text, "0123456789abcdefABCDEF") != 32)
        return json_fail(fault, path, "32 hexadecimal digits are needed");
    for (int i = 0; i < 16; i++)
        sscanf(text + 2 * i, "%2hhx", &request->client[i]);
    request->has_client = true;
    return true;
}

static bool read_sequence(const json_t *value, const struct json_path *path,
                          struct json_request *request, struct json_fault *fault)
{
    if (!json_is_integer(value) || json_integer_value(value) < 1)
        return json_fail(fault, path, "a whole number >= 1 is needed");
    request->request.sequence = (uint64_t)json_integer_value(value);
    return true;
}

static bool read_options(const json_t *value, const struct json_path *path,
                         struct json_request *request, struct json_fault *fault)
{
    return json_read_object(value, path, options_members(), &request->request.options, fault);
}

/* In the order in which they must be read. */
static const struct {
    const char *name;
    bool (*read)(const json_t *, const struct json_path *, struct json_request *,
                 struct json_fault *);
} request_members[] = {
    {"bodies", read_bodies},   {"contacts", read_contacts}, {"delassus", read_delassus},
    {"options", read_options}, {"client", read_client},     {"sequence", read_sequence},
};
enum { REQUEST_MEMBERS = sizeof request_members / sizeof request_members[0] };

static bool check_members(const json_t *root, struct json_fault *fault)
{
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)root, name, value)
    {
        size_t i = 0;
        while (i < REQUEST_MEMBERS && strcmp(request_members[i].name, name))
            i++;
        if (i == REQUEST_MEMBERS)
            return json_fail(fault, &(struct json_path){NULL, name, 0},
                             "unknown member; allowed are: bodies, contacts, delassus, options, "
                             "client, sequence");
    }
    return true;
}

bool request_json_read(const json_t *root, struct json_request *request, struct json_fault *fault)
{
    percuss_request_init(&request->request);
    request->has_client = false;
    if (!json_is_object(root))
        return json_fail(fault, NULL, "a request is an object, not %s", json_kind_of(root));
    if (!check_members(root, fault))
        return false;
    for (size_t i = 0; i < REQUEST_MEMBERS; i++) {
        const json_t *value = json_object_get(root, request_members[i].name);
        struct json_path path = {NULL, request_members[i].name, 0};
        if (value && !request_members[i].read(value, &path, request, fault))
            return false;
    }
    return true;
}

bool request_json_load(const char *file, struct json_request *request, struct json_fault *fault)
{
    json_error_t error;
    bool standard_input = !strcmp(file, "-");
    const char *name = standard_input ? "standard input" : file;
    json_t *root = standard_input ? json_loadf(stdin, JSON_REJECT_DUPLICATES, &error)
                                  : json_load_file(file, JSON_REJECT_DUPLICATES, &error);
    if (!root) {
        if (error.line > 0)
            return json_fail(fault, NULL, "%s: line %d, column %d: %s", name, error.line,
                             error.column, error.text);
        return json_fail(fault, NULL, "%s: %s", name, error.text);
    }
    bool read = request_json_read(root, request, fault);
    json_decref(root);
    return read;
}

static json_t *list_schema(const struct json_member *members, int most, const char *what)
{
    return json_pack("{sssisoss}", "type", "array", "maxItems", most, "items",
                     json_schema(members, true), "description", what);
}

json_t *request_schema(void)
{
    json_t *matrix = json_pack("{sss{s[ss]}ss}", "type", "array", "items", "type", "number",
                               "array", "description",
                               "1/kg; n rows of n numbers for n contacts, W of the simulator's own "
                               "bodies; absent: of the catalogue's");
    json_t *options = json_schema(options_members(), true);
    json_object_set_new(options, "description", json_string("how it is solved"));
    json_t *client = json_pack(
        "{ssssss}", "type", "string", "pattern", "^[0-9a-fA-F]{32}$", "description",
        "who asks; absent: a new one. With the same sequence the reply is the stored one");
    json_t *sequence = json_pack("{sssiss}", "type", "integer", "minimum", 1, "description",
                                 "of the client's requests; absent: the next");
    json_t *properties = json_pack(
        "{sosososososo}", "bodies",
        list_schema(body_motion_members(), PERCUSS_MAX_BODIES, "that may meet, and how they move"),
        "contacts", list_schema(contact_members(), PERCUSS_MAX_CONTACTS, "where they meet"),
        "delassus", matrix, "options", options, "client", client, "sequence", sequence);
    return json_pack("{sssosb}", "type", "object", "properties", properties, "additionalProperties",
                     false);
}
