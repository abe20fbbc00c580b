/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "json_writer.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "cli.h"

json_t *json_number(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

static json_t *text(const char *text)
{
    json_t *value = json_string(text);
    return value ? value : json_null();
}

static json_t *octets(const uint8_t octets[16])
{
    char digits[33];
    format_hex(octets, digits);
    return json_string(digits);
}

static json_t *numbers(const double *numbers, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, json_number(numbers[i]));
    return array;
}

static json_t *counts(const uint64_t *counts, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, json_integer((json_int_t)counts[i]));
    return array;
}

static json_t *texts(char *const *texts, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array, json_string(texts[i]));
    return array;
}

static json_t *objects(const struct json_member *member, const char *elements, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(array,
                              json_object_of(member->members(), elements + i * member->size));
    return array;
}

static json_t *overrides(const struct json_member *member, const struct percuss_override *overrides,
                         size_t count)
{
    json_t *value = json_object();
    for (size_t i = 0; i < count; i++)
        json_object_set_new(value, member->name_of(overrides[i].parameter),
                            json_number(overrides[i].value));
    return value;
}

static size_t count_of(const struct json_member *member, const void *source)
{
    const char *at = (const char *)source + member->count_offset;
    return member->count_size == sizeof(uint32_t) ? *(const uint32_t *)at : *(const size_t *)at;
}

static json_t *value(const struct json_member *member, const void *source)
{
    const void *at = (const char *)source + member->offset;
    switch (member->kind) {
    case JSON_KIND_NUMBER:
        return json_number(*(const double *)at);
    case JSON_KIND_VECTOR:
        return numbers(at, member->size);
    case JSON_KIND_TEXT:
        return text(at);
    case JSON_KIND_OCTETS:
        return octets(at);
    case JSON_KIND_COUNT:
        return json_integer(*(const uint32_t *)at);
    case JSON_KIND_LONG_COUNT:
        return json_integer((json_int_t) * (const uint64_t *)at);
    case JSON_KIND_FLAG:
        return json_boolean(*(const bool *)at);
    case JSON_KIND_CHOICE:
        return text(member->name_of(*(const unsigned *)at));
    case JSON_KIND_OVERRIDES:
        return overrides(member, at, count_of(member, source));
    case JSON_KIND_OBJECT:
        return json_object_of(member->members(), at);
    case JSON_KIND_LIST:
        return objects(member, *(const char *const *)at, count_of(member, source));
    case JSON_KIND_TEXTS:
        return texts(*(char *const *const *)at, count_of(member, source));
    case JSON_KIND_NUMBERS:
        return numbers(*(const double *const *)at, count_of(member, source));
    case JSON_KIND_EDGES:
        return numbers(*(const double *const *)at,
                       count_of(member, source) + (count_of(member, source) > 0));
    case JSON_KIND_COUNTS:
        return counts(*(const uint64_t *const *)at, count_of(member, source));
    }
    return NULL;
}

json_t *json_object_of(const struct json_member *members, const void *source)
{
    json_t *object = json_object();
    for (; members->name; members++)
        json_object_set_new(object, members->name, value(members, source));
    return object;
}

void json_print(json_t *value)
{
    json_dumpf(value, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    putchar('\n');
    json_decref(value);
}
