/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Structs as JSON objects by their tables of members. */
#ifndef PERCUSS_CLI_JSON_WRITER_H
#define PERCUSS_CLI_JSON_WRITER_H

#include <jansson.h>

#include "json_fields.h"

/* The struct as an object: choices as their names, undefined and infinite numbers as null, and so
 * is a text that is not UTF-8. The caller releases it. NULL: out of memory. */
json_t *json_object_of(const struct json_member *members, const void *source);

/* A number, or null where it is undefined or infinite. */
json_t *json_number(double number);

/* A text, or null where it is not UTF-8. NULL: out of memory. */
json_t *json_text_or_null(const char *text);

/* As text with 17 significant digits, for free(). NULL: out of memory, or no value. */
char *json_text(const json_t *value);

/* Prints with 17 significant digits and a line end to stdout, and releases the value; ends the
 * program where there is no memory for that, or for the value (NULL). */
void json_print(json_t *value);

#endif
