/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tables of the members of public structs, made of the lists of percuss/fields.h, by which JSON is
 * read, written and described.
 *
 *     JSON_TABLE(contact, PERCUSS_CONTACT_FIELDS)
 *
 * defines contact_members(), the table of struct percuss_contact; those of the elements of its
 * lists must have been defined before. */
#ifndef PERCUSS_CLI_JSON_FIELDS_H
#define PERCUSS_CLI_JSON_FIELDS_H

#include <math.h>
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
    JSON_KIND_TEXTS,      /* a pointer to texts */
    JSON_KIND_NUMBERS,    /* a pointer to doubles */
    JSON_KIND_EDGES,      /* the same, one more than are counted, but none for none */
    JSON_KIND_COUNTS      /* a pointer to uint64_t */
};

struct json_member {
    const char *name; /* NULL: end of the table */
    enum json_kind kind;
    size_t offset; /* in the struct */
    size_t size;
    const char *(*name_of)(unsigned number);
    const struct json_member *(*members)(void); /* of an object, or of a list's elements */
    size_t count_offset, count_size;            /* of the number of elements */
    double low, high; /* of numbers: finite: a range; infinite: may be undefined; both 0: any */
    bool defaulted;   /* or 0 for the default */
    const char *what; /* it is, beginning with the unit */
};

#define JSON_TABLE(element, fields)                                                                \
    static const struct json_member *element##_members(void)                                       \
    {                                                                                              \
        typedef struct percuss_##element json_struct;                                              \
        static const struct json_member members[] = {fields(JSON_MEMBER, JSON_MEMBER){0}};         \
        return members;                                                                            \
    }

#define JSON_MEMBER(kind, name, ...) JSON_MEMBER_##kind(name, __VA_ARGS__)

#define JSON_MEMBER_NUMBER(name, least, most, what)                                                \
    JSON_ROW(name, NUMBER, 1, what, .low = least, .high = most)
#define JSON_MEMBER_DEFAULTED(name, least, most, what)                                             \
    JSON_ROW(name, NUMBER, 1, what, .low = least, .high = most, .defaulted = true)
#define JSON_MEMBER_VALUE(name, what) JSON_MEMBER_NUMBER(name, -INFINITY, INFINITY, what)
#define JSON_MEMBER_VECTOR(name, most, what)                                                       \
    JSON_ROW(name, VECTOR, 3, what, .low = -(most), .high = most)
#define JSON_MEMBER_PAIR(name, what)                                                               \
    JSON_ROW(name, VECTOR, 2, what, .low = -INFINITY, .high = INFINITY)
#define JSON_MEMBER_UNIT(name, count, what) JSON_ROW(name, VECTOR, count, what)
#define JSON_MEMBER_ID(name, what)          JSON_MEMBER_TEXT(name, what)
#define JSON_MEMBER_TEXT(name, what)        JSON_ROW(name, TEXT, sizeof JSON_AT(name), what)
#define JSON_MEMBER_OCTETS(name, what)      JSON_ROW(name, OCTETS, 16, what)
#define JSON_MEMBER_INDEX(name, what)       JSON_ROW(name, COUNT, 1, what)
#define JSON_MEMBER_COUNT(name, what)       JSON_ROW(name, COUNT, 1, what)
#define JSON_MEMBER_LONG_COUNT(name, what)  JSON_ROW(name, LONG_COUNT, 1, what)
#define JSON_MEMBER_FLAG(name, what)        JSON_ROW(name, FLAG, 1, what)
#define JSON_MEMBER_CHOICE(name, choice, count, what)                                              \
    JSON_ROW(name, CHOICE, count, what, .name_of = percuss_##choice##_name)
#define JSON_MEMBER_OBJECT(name, element, what)                                                    \
    JSON_ROW(name, OBJECT, 1, what, .members = element##_members)
#define JSON_MEMBER_OPTIONAL(name, element, what) JSON_MEMBER_OBJECT(name, element, what)
#define JSON_MEMBER_LIST(name, count, element, what)                                               \
    JSON_ROW(name, LIST, sizeof *JSON_AT(name), what, .members = element##_members,                \
             JSON_COUNT(count))
#define JSON_MEMBER_TEXTS(name, count, what)   JSON_ROW(name, TEXTS, 1, what, JSON_COUNT(count))
#define JSON_MEMBER_NUMBERS(name, count, what) JSON_ROW(name, NUMBERS, 1, what, JSON_COUNT(count))
#define JSON_MEMBER_EDGES(name, count, what)   JSON_ROW(name, EDGES, 1, what, JSON_COUNT(count))
#define JSON_MEMBER_COUNTS(name, count, what)  JSON_ROW(name, COUNTS, 1, what, JSON_COUNT(count))
#define JSON_MEMBER_OVERRIDES(name, count, what)                                                   \
    JSON_ROW(name, OVERRIDES, PERCUSS_PARAMETER_COUNT, what, .name_of = percuss_parameter_name,    \
             JSON_COUNT(count))

#define JSON_ROW(member, json_kind, number, text, ...)                                             \
    {.name = #member,                                                                              \
     .kind = JSON_KIND_##json_kind,                                                                \
     .offset = offsetof(json_struct, member),                                                      \
     .size = number,                                                                               \
     .what = text,                                                                                 \
     __VA_ARGS__},
#define JSON_AT(member) ((json_struct *)NULL)->member
#define JSON_COUNT(member)                                                                         \
    .count_offset = offsetof(json_struct, member), .count_size = sizeof JSON_AT(member)

#endif
