/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "json_reader.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Appends to a text of `size` bytes and cuts what does not fit. */
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

bool json_fail(struct json_fault *fault, const struct json_path *path, const char *format, ...)
{
    fault->text[0] = '\0';
    append_path(fault->text, sizeof fault->text, path);
    append(fault->text, sizeof fault->text, "%s", *fault->text ? ": " : "");
    size_t length = strlen(fault->text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text + length, sizeof fault->text - length, format, arguments);
    va_end(arguments);
    /* what the file holds goes to a terminal */
    for (char *c = fault->text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f)
            *c = '?';
    return false;
}

const char *json_kind_of(const json_t *value)
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

bool json_read_numbers(const json_t *array, const struct json_path *path, size_t count,
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

/* In the order of the parameters, whatever theirs is. */
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

bool json_read_object(const json_t *object, const struct json_path *path,
                      const struct json_member *members, void *target, struct json_fault *fault)
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
