/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tables of the members of structs that are objects in JSON, made of the lists of percuss/fields.h:
 *
 *     #define JSON_STRUCT struct percuss_contact
 *     static const struct json_member contact_members[] = {PERCUSS_CONTACT_FIELDS(JSON_MEMBER)
 * {0}}; #undef JSON_STRUCT
 */
#ifndef PERCUSS_CLI_JSON_FIELDS_H
#define PERCUSS_CLI_JSON_FIELDS_H

#include <percuss/fields.h>
#include <stddef.h>

enum json_kind {
    JSON_KIND_NUMBER, /* double */
    JSON_KIND_VECTOR, /* `size` doubles */
    JSON_KIND_TEXT,   /* char[size] */
    JSON_KIND_INDEX,  /* uint32_t */
    JSON_KIND_FLAG,   /* bool */
    JSON_KIND_NAMED,  /* `size` doubles, an object's members by the names that `name_of` gives their
                         indices; absent ones stay as they are */
    JSON_KIND_CHOICE  /* unsigned, by the name that `name_of` gives its numbers below `size` */
};

struct json_member {
    const char *name; /* NULL: end of the table */
    enum json_kind kind;
    size_t offset; /* in the struct */
    size_t size;
    const char *(*name_of)(unsigned number);
};

#define JSON_MEMBER(kind, name, ...) JSON_MEMBER_##kind(name, __VA_ARGS__)

#define JSON_MEMBER_NUMBER(name, ...)      JSON_ROW(name, NUMBER, 1)
#define JSON_MEMBER_DEFAULTED(name, ...)   JSON_ROW(name, NUMBER, 1)
#define JSON_MEMBER_VECTOR(name, ...)      JSON_ROW(name, VECTOR, 3)
#define JSON_MEMBER_UNIT(name, count, ...) JSON_ROW(name, VECTOR, count)
#define JSON_MEMBER_ID(name, ...)          JSON_ROW(name, TEXT, JSON_SIZE(name))
#define JSON_MEMBER_TEXT(name, ...)        JSON_ROW(name, TEXT, JSON_SIZE(name))
#define JSON_MEMBER_INDEX(name, ...)       JSON_ROW(name, INDEX, 1)
#define JSON_MEMBER_FLAG(name, ...)        JSON_ROW(name, FLAG, 1)
#define JSON_MEMBER_CHOICE(name, choice, count, ...)                                               \
    JSON_ROW(name, CHOICE, count, .name_of = percuss_##choice##_name)

#define JSON_ROW(member, json_kind, count, ...)                                                    \
    {.name = #member,                                                                              \
     .kind = JSON_KIND_##json_kind,                                                                \
     .offset = offsetof(JSON_STRUCT, member),                                                      \
     .size = count,                                                                                \
     __VA_ARGS__},
#define JSON_SIZE(member) sizeof((JSON_STRUCT *)NULL)->member

#endif
