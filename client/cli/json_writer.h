/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Structs as JSON objects by their tables of members. */
#ifndef PERCUSS_CLI_JSON_WRITER_H
#define PERCUSS_CLI_JSON_WRITER_H

#include <jansson.h>

#include "json_fields.h"

/* The struct as an object: choices as their names, undefined and infinite numbers as null, and so
 * is a text that is not UTF-8. The caller releases it. */
json_t *json_object_of(const struct json_member *members, const void *source);

/* A number, or null where it is undefined or infinite. */
json_t *json_number(double number);

/* Prints with 17 significant digits and a line end to stdout, and releases the value. */
void json_print(json_t *value);

#endif
