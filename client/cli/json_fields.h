/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tables of the members of public structs, made of the lists of percuss/fields.h, by which JSON is
 * read and written.
 *
 *     JSON_TABLE(contact, PERCUSS_CONTACT_FIELDS)
 *
 * defines contact_members(), the table of struct percuss_contact; those of the elements of its
 * lists must have been defined before. */
#ifndef PERCUSS_CLI_JSON_FIELDS_H
#define PERCUSS_CLI_JSON_FIELDS_H

#include <percuss/fields.h>
#include <percuss/percuss.h>
#include <stddef.h>

enum json_kind {
    JSON_KIND_NUMBER,     /* double; null: undefined or infinite */
    JSON_KIND_VECTOR,     /* `size` doubles */
    JSON_KIND_TEXT,       /* char[size] */
    JSON_KIND_OCTETS,     /* uint8_t[16], in hexadecimal digits */
    JSON_KIND_COUNT,      /* uint32_t */
    JSON_KIND_LONG_COUNT, /* uint64_t */
    JSON_KIND_FLAG,       /* bool */
    JSON_KIND_CHOICE,     /* unsigned, by the name that `name_of` gives its numbers below `size` */
    JSON_KIND_OVERRIDES,  /* struct percuss_override[], an object with members by parameter */
    JSON_KIND_OBJECT,     /* a struct */
    JSON_KIND_LIST,       /* a pointer to structs of `size` bytes */
    JSON_KIND_TEXTS       /* a pointer to texts */
};

struct json_member {
    const char *name; /* NULL: end of the table */
    enum json_kind kind;
    size_t offset; /* in the struct */
    size_t size;
    const char *(*name_of)(unsigned number);
    const struct json_member *(*members)(void); /* of an object, or of a list's elements */
    size_t count_offset, count_size;            /* of the number of elements */
};

#define JSON_TABLE(element, fields)                                                                \
    static const struct json_member *element##_members(void)                                       \
    {                                                                                              \
        typedef struct percuss_##element json_struct;                                              \
        static const struct json_member members[] = {fields(JSON_MEMBER, JSON_MEMBER){0}};         \
        return members;                                                                            \
    }

#define JSON_MEMBER(kind, name, ...) JSON_MEMBER_##kind(name, __VA_ARGS__)

#define JSON_MEMBER_NUMBER(name, ...)      JSON_ROW(name, NUMBER, 1)
#define JSON_MEMBER_DEFAULTED(name, ...)   JSON_ROW(name, NUMBER, 1)
#define JSON_MEMBER_VALUE(name, ...)       JSON_ROW(name, NUMBER, 1)
#define JSON_MEMBER_VECTOR(name, ...)      JSON_ROW(name, VECTOR, 3)
#define JSON_MEMBER_UNIT(name, count, ...) JSON_ROW(name, VECTOR, count)
#define JSON_MEMBER_ID(name, ...)          JSON_ROW(name, TEXT, sizeof JSON_AT(name))
#define JSON_MEMBER_TEXT(name, ...)        JSON_ROW(name, TEXT, sizeof JSON_AT(name))
#define JSON_MEMBER_OCTETS(name, ...)      JSON_ROW(name, OCTETS, 16)
#define JSON_MEMBER_INDEX(name, ...)       JSON_ROW(name, COUNT, 1)
#define JSON_MEMBER_COUNT(name, ...)       JSON_ROW(name, COUNT, 1)
#define JSON_MEMBER_LONG_COUNT(name, ...)  JSON_ROW(name, LONG_COUNT, 1)
#define JSON_MEMBER_FLAG(name, ...)        JSON_ROW(name, FLAG, 1)
#define JSON_MEMBER_CHOICE(name, choice, count, ...)                                               \
    JSON_ROW(name, CHOICE, count, .name_of = percuss_##choice##_name)
#define JSON_MEMBER_OBJECT(name, element, ...)                                                     \
    JSON_ROW(name, OBJECT, 1, .members = element##_members)
#define JSON_MEMBER_LIST(name, count, element, ...)                                                \
    JSON_ROW(name, LIST, sizeof *JSON_AT(name), .members = element##_members, JSON_COUNT(count))
#define JSON_MEMBER_TEXTS(name, count, ...) JSON_ROW(name, TEXTS, 1, JSON_COUNT(count))
#define JSON_MEMBER_OVERRIDES(name, count, ...)                                                    \
    JSON_ROW(name, OVERRIDES, PERCUSS_PARAMETER_COUNT, .name_of = percuss_parameter_name,          \
             JSON_COUNT(count))

#define JSON_ROW(member, json_kind, number, ...)                                                   \
    {.name = #member,                                                                              \
     .kind = JSON_KIND_##json_kind,                                                                \
     .offset = offsetof(json_struct, member),                                                      \
     .size = number,                                                                               \
     __VA_ARGS__},
#define JSON_AT(member) ((json_struct *)NULL)->member
#define JSON_COUNT(member)                                                                         \
    .count_offset = offsetof(json_struct, member), .count_size = sizeof JSON_AT(member)

#endif
