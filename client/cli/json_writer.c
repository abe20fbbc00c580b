/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "json_writer.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli.h"
#include "fold.h"

json_t *json_number(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

json_t *json_text_or_null(const char *text)
{
    errno = 0;
    json_t *value = json_string(text);
    return value || errno == ENOMEM ? value : json_null();
}

/* An array or object without one of its members is none. NULL: out of memory, here and below. */
static json_t *whole_or_none(json_t *value, bool whole)
{
    if (whole)
        return value;
    json_decref(value);
    return NULL;
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
    bool good = array;
    for (size_t i = 0; good && i < count; i++)
        good = json_array_append_new(array, json_number(numbers[i])) == 0;
    return whole_or_none(array, good);
}

static json_t *counts(const uint64_t *counts, size_t count)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < count; i++)
        good = json_array_append_new(array, json_integer((json_int_t)counts[i])) == 0;
    return whole_or_none(array, good);
}

static json_t *texts(char *const *texts, size_t count)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < count; i++)
        good = json_array_append_new(array, json_text_or_null(texts[i])) == 0;
    return whole_or_none(array, good);
}

static json_t *objects(const struct json_member *member, const char *elements, size_t count)
{
    json_t *array = json_array();
    bool good = array;
    for (size_t i = 0; good && i < count; i++)
        good = json_array_append_new(
                   array, json_object_of(member->members(), elements + i * member->size)) == 0;
    return whole_or_none(array, good);
}

static json_t *overrides(const struct json_member *member, const struct percuss_override *overrides,
                         size_t count)
{
    json_t *value = json_object();
    bool good = value;
    for (size_t i = 0; good && i < count; i++)
        good = json_object_set_new(value, member->name_of(overrides[i].parameter),
                                   json_number(overrides[i].value)) == 0;
    return whole_or_none(value, good);
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
        return json_text_or_null(at);
    case JSON_KIND_OCTETS:
        return octets(at);
    case JSON_KIND_COUNT:
        return json_integer(*(const uint32_t *)at);
    case JSON_KIND_LONG_COUNT:
        return json_integer((json_int_t) * (const uint64_t *)at);
    case JSON_KIND_FLAG:
        return json_boolean(*(const bool *)at);
    case JSON_KIND_CHOICE:
        return json_text_or_null(member->name_of(*(const unsigned *)at));
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
    bool good = object;
    for (; good && members->name; members++)
        good = json_object_set_new(object, members->name, value(members, source)) == 0;
    return whole_or_none(object, good);
}

char *json_text(const json_t *value)
{
    static const size_t flags = JSON_INDENT(2) | JSON_REAL_PRECISION(17);
    /* json_dumps of jansson 2.14 loses a key where its buffer cannot grow */
    size_t size = value ? json_dumpb(value, NULL, 0, flags) : 0;
    char *text = size ? malloc(size + 1) : NULL;
    if (!text)
        return NULL;
    if (json_dumpb(value, text, size, flags) != size) {
        free(text);
        return NULL;
    }
    text[size] = '\0';
    return text;
}

void json_print(json_t *value)
{
    /* half an object is none; that stdout cannot be written to is seen at the end */
    char *text = json_text(value);
    if (!text) {
        fprintf(stderr, "percuss: out of memory\n");
        exit(EXIT_ANSWERED_WITH_WARNING);
    }
    fold_end();
    puts(text);
    free(text);
    json_decref(value);
}
