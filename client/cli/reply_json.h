/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_CLI_REPLY_JSON_H
#define PERCUSS_CLI_REPLY_JSON_H

#include <jansson.h>
#include <percuss/reply.h>

/* The reply with the wire's names and nesting; choices as their names, undefined and infinite
 * numbers as null. The caller releases it. */
json_t *reply_to_json(const struct percuss_reply *reply);

/* A number, or null where it is undefined or infinite. */
json_t *json_number(double number);

/* Prints with 17 significant digits and a line end to stdout, and releases the value. */
void json_print(json_t *value);

#endif
