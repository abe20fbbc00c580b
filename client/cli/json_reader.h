/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Strict reading of JSON objects into structs by a table of members. Every failure names the path
 * of the member, what is there and what is allowed. */
#ifndef PERCUSS_CLI_JSON_READER_H
#define PERCUSS_CLI_JSON_READER_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#include "json_fields.h"

/* Where the reader is, for messages. */
struct json_path {
    const struct json_path *parent; /* NULL: the outermost object */
    const char *member;             /* NULL: element `index` of the parent */
    size_t index;
};

struct json_fault {
    char text[512];
};

/* Writes the path ("bodies[0].velocity") and the message; returns false. */
bool json_fail(struct json_fault *fault, const struct json_path *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* "an object", "text", ... */
const char *json_kind_of(const json_t *value);

/* Reads the object's members into `target`; members that are absent leave it as it is. False for
 * something else than an object, an unknown member (a table's end is a NULL name), a wrong type or
 * a wrong length. */
bool json_read_object(const json_t *object, const struct json_path *path,
                      const struct json_member *members, void *target, struct json_fault *fault);

/* Reads an array of exactly `count` numbers. */
bool json_read_numbers(const json_t *array, const struct json_path *path, size_t count,
                       double *numbers, struct json_fault *fault);

#endif
