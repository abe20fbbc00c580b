/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests as JSON: a strict reader of objects by tables of members, and the members of a request.
 */

#include "request_json.h"

#include <jansson.h>
#include <percuss/percuss.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "json_fields.h"
#include "json_schema.h"
#include "json_writer.h"

/* Strict reading of JSON objects into structs by a table of members. Every failure names the path
 * of the member, its value and what is allowed. */

/* Where the reader is, for messages. */
struct json_path {
    const struct json_path *parent; /* NULL: the outermost object */
    const char *member;             /* NULL: element `index` of the parent */
    size_t index;
};

/* Appends to a text of `size` bytes, cut to fit. */
static void append(char *text, size_t size, const char *format, ...)
{
    size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, size - length, format, arguments);
    va_end(arguments);
}

static void append_path(char *text, size_t size, const struct json_path *path)
{
    if (!path)
        return;
    append_path(text, size, path->parent);
    if (!path->member)
        append(text, size, "[%zu]", path->index);
    else
        append(text, size, "%s%s", *text ? "." : "", path->member);
}

/* Writes the path ("bodies[0].velocity") and the message; returns false. */
__attribute__((format(printf, 3, 4))) static bool
json_fail(struct json_fault *fault, const struct json_path *path, const char *format, ...)
{
    fault->text[0] = '\0';
    append_path(fault->text, sizeof fault->text, path);
    append(fault->text, sizeof fault->text, "%s", *fault->text ? ": " : "");
    size_t length = strlen(fault->text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text + length, sizeof fault->text - length, format, arguments);
    va_end(arguments);
    /* text of the file goes to a terminal */
    for (char *c = fault->text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f)
            *c = '?';
    return false;
}

/* "an object", "text", ... */
static const char *json_kind_of(const json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "an array";
    case JSON_STRING:
        return "text";
    case JSON_INTEGER:
    case JSON_REAL:
        return "a number";
    case JSON_NULL:
        return "null";
    default:
        return "true or false";
    }
}

/* Reads an array of exactly `count` numbers. */
static bool json_read_numbers(const json_t *array, const struct json_path *path, size_t count,
                              double *numbers, struct json_fault *fault)
{
    if (!json_is_array(array))
        return json_fail(fault, path, "%zu numbers are needed, not %s", count, json_kind_of(array));
    if (json_array_size(array) != count)
        return json_fail(fault, path, "%zu numbers are needed, not %zu", count,
                         json_array_size(array));
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(array, i);
        if (!json_is_number(value))
            return json_fail(fault, &(struct json_path){path, NULL, i},
                             "a number is needed, not %s", json_kind_of(value));
        numbers[i] = json_number_value(value);
    }
    return true;
}

static bool read_text(const json_t *value, const struct json_path *path, size_t size, char *text,
                      struct json_fault *fault)
{
    if (!json_is_string(value))
        return json_fail(fault, path, "text is needed, not %s", json_kind_of(value));
    if (json_string_length(value) >= size)
        return json_fail(fault, path, "up to %zu bytes are allowed, not %zu", size - 1,
                         json_string_length(value));
    strcpy(text, json_string_value(value));
    return true;
}

static bool read_index(const json_t *value, const struct json_path *path, uint32_t *index,
                       struct json_fault *fault)
{
    json_int_t number = json_integer_value(value);
    if (!json_is_integer(value) || number < 0 || number > UINT32_MAX)
        return json_fail(fault, path, "a whole number >= 0 is needed");
    *index = (uint32_t)number;
    return true;
}

static bool read_choice(const json_t *value, const struct json_path *path,
                        const struct json_member *member, unsigned *choice,
                        struct json_fault *fault)
{
    const char *given = json_is_string(value) ? json_string_value(value) : NULL;
    char allowed[256] = "";
    for (unsigned i = 0; i < member->size; i++) {
        if (given && !strcmp(given, member->name_of(i))) {
            *choice = i;
            return true;
        }
        append(allowed, sizeof allowed, "%s%s", i ? ", " : "", member->name_of(i));
    }
    if (!given)
        return json_fail(fault, path, "one of %s is needed, not %s", allowed, json_kind_of(value));
    return json_fail(fault, path, "'%s' is not one of: %s", given, allowed);
}

/* In the order of the parameters, not in that of the file. */
static bool read_overrides(const json_t *object, const struct json_path *path,
                           const struct json_member *member, struct percuss_body_motion *body,
                           struct json_fault *fault)
{
    const char *name;
    json_t *value;
    if (!json_is_object(object))
        return json_fail(fault, path, "an object is needed, not %s", json_kind_of(object));
    /* numbers for parameters that there are */
    json_object_foreach((json_t *)object, name, value)
    {
        struct json_path here = {path, name, 0};
        char allowed[256] = "";
        unsigned i = 0;
        for (; i < member->size && strcmp(name, member->name_of(i)); i++)
            append(allowed, sizeof allowed, "%s%s", i ? ", " : "", member->name_of(i));
        if (i == member->size)
            return json_fail(fault, &here, "unknown member; allowed are: %s", allowed);
        if (!json_is_number(value))
            return json_fail(fault, &here, "a number is needed, not %s", json_kind_of(value));
    }
    /* in the order of the parameters, not of the file */
    for (unsigned i = 0; i < member->size; i++)
        if ((value = json_object_get(object, member->name_of(i))))
            body->overrides[body->override_count++] =
                (struct percuss_override){i, json_number_value(value)};
    return true;
}

static bool read_member(const json_t *value, const struct json_path *path,
                        const struct json_member *member, void *structure, struct json_fault *fault)
{
    void *target = (char *)structure + member->offset;
    switch (member->kind) {
    case JSON_KIND_NUMBER:
        if (!json_is_number(value))
            return json_fail(fault, path, "a number is needed, not %s", json_kind_of(value));
        *(double *)target = json_number_value(value);
        return true;
    case JSON_KIND_VECTOR:
        return json_read_numbers(value, path, member->size, target, fault);
    case JSON_KIND_TEXT:
        return read_text(value, path, member->size, target, fault);
    case JSON_KIND_COUNT:
        return read_index(value, path, target, fault);
    case JSON_KIND_FLAG:
        if (!json_is_boolean(value))
            return json_fail(fault, path, "true or false is needed, not %s", json_kind_of(value));
        *(bool *)target = json_is_true(value);
        return true;
    case JSON_KIND_OVERRIDES:
        return read_overrides(value, path, member, structure, fault);
    case JSON_KIND_CHOICE:
        return read_choice(value, path, member, target, fault);
    default: /* only in replies */
        return json_fail(fault, path, "is not read");
    }
}

static bool unknown_member(const struct json_path *path, const struct json_member *members,
                           struct json_fault *fault)
{
    char allowed[384] = "";
    for (size_t i = 0; members[i].name; i++)
        append(allowed, sizeof allowed, "%s%s", i ? ", " : "", members[i].name);
    return json_fail(fault, path, "unknown member; allowed are: %s", allowed);
}

/* Reads the object's members into `target`; members that are absent leave it as it is. False for
 * something else than an object, an unknown member (a table's end is a NULL name), a wrong type or
 * a wrong length. */
static bool json_read_object(const json_t *object, const struct json_path *path,
                             const struct json_member *members, void *target,
                             struct json_fault *fault)
{
    const char *name;
    json_t *value;
    if (!json_is_object(object))
        return json_fail(fault, path, "an object is needed, not %s", json_kind_of(object));
    json_object_foreach((json_t *)object, name, value)
    {
        struct json_path here = {path, name, 0};
        const struct json_member *member = members;
        while (member->name && strcmp(member->name, name))
            member++;
        if (!member->name)
            return unknown_member(&here, members, fault);
        if (!read_member(value, &here, member, target, fault))
            return false;
    }
    return true;
}

JSON_TABLE(body_motion, PERCUSS_BODY_FIELDS)
JSON_TABLE(contact, PERCUSS_CONTACT_FIELDS)
JSON_TABLE(options, PERCUSS_OPTION_FIELDS)

/* Elements of a request as an array. NULL: out of memory. */
static json_t *array_of(const struct json_member *members, const char *elements, size_t count,
                        size_t size)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < count; i++)
        good = json_array_append_new(array, json_object_of(members, elements + i * size)) == 0;
    if (good)
        return array;
    json_decref(array);
    return NULL;
}

json_t *request_to_json(const struct percuss_request *request)
{
    json_t *object = json_pack("{sososo}", "bodies",
                               array_of(body_motion_members(), (const char *)request->bodies,
                                        request->body_count, sizeof *request->bodies),
                               "contacts",
                               array_of(contact_members(), (const char *)request->contacts,
                                        request->contact_count, sizeof *request->contacts),
                               "options", json_object_of(options_members(), &request->options));
    size_t rows = request->delassus_rows ? request->delassus_rows : request->contact_count;
    rows = request->delassus ? rows : 0;
    json_t *delassus = object && rows ? json_array() : NULL;
    bool good = object && (rows == 0 || delassus);
    for (size_t i = 0; good && i < rows * rows; i++)
        good = json_array_append_new(delassus, json_number(request->delassus[i])) == 0;
    if (delassus)
        good = json_object_set_new(object, "delassus", delassus) == 0 && good;
    if (good)
        return object;
    json_decref(object);
    return NULL;
}

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

/* Rows of a matrix for the n contacts: n, or 3n with their tangents, as far as the wire has room.
 */
static bool choose_rows(size_t given, const struct json_path *path, struct json_request *request,
                        struct json_fault *fault)
{
    size_t contacts = request->request.contact_count, rows = 3 * contacts;
    request->request.delassus = request->delassus;
    request->request.delassus_rows = given == rows ? rows : contacts;
    if (given != contacts && given != rows)
        return json_fail(fault, path,
                         "%zu rows are needed, one a contact, or %zu with both tangents, not %zu",
                         contacts, rows, given);
    if (given * given > PERCUSS_MAX_DELASSUS)
        return json_fail(fault, path,
                         "%zu rows are too many: of normals and tangents up to %d contacts are "
                         "allowed, not %zu",
                         given, PERCUSS_MAX_CONTACTS_OBLIQUE, contacts);
    return true;
}

/* Rows of numbers, or all numbers in one list. The contacts are read before. */
static bool read_delassus(const json_t *array, const struct json_path *path,
                          struct json_request *request, struct json_fault *fault)
{
    size_t contacts = request->request.contact_count;
    if (!json_is_array(array))
        return json_fail(fault, path, "an array is needed, not %s", json_kind_of(array));
    size_t given = json_array_size(array);
    bool flat = !json_is_array(json_array_get(array, 0));
    if (flat && given != contacts * contacts && given != 9 * contacts * contacts)
        return json_fail(fault, path, "%zu numbers are needed, or %zu with both tangents, not %zu",
                         contacts * contacts, 9 * contacts * contacts, given);
    if (flat)
        given = given == contacts * contacts ? contacts : 3 * contacts;
    if (!choose_rows(given, path, request, fault))
        return false;
    if (flat)
        return json_read_numbers(array, path, given * given, request->delassus, fault);
    for (size_t i = 0; i < given; i++)
        if (!json_read_numbers(json_array_get(array, i), &(struct json_path){path, NULL, i}, given,
                               request->delassus + i * given, fault))
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
                               "bodies; where a contact has friction 3n rows of 3n: normal, first "
                               "and second tangent of each; absent: of the catalogue's");
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
