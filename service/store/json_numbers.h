/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbers in the JSON of contact tables. Refusals are BAD_REQUEST with the name and the allowed
 * values; INTERNAL: no memory. */
#ifndef PERCUSS_STORE_JSON_NUMBERS_H
#define PERCUSS_STORE_JSON_NUMBERS_H

#include <jansson.h>
#include <stddef.h>

#include "base/fault.h"

/* The text as JSON; the caller owns the reference. */
enum percuss_status json_numbers_parse(const char *text, size_t size, json_t **root,
                                       struct fault *fault);

/* An array of numbers; the caller owns the reference. NULL: out of memory. */
json_t *json_numbers(size_t count, const double *values);

/* A finite number. */
enum percuss_status json_numbers_take(const json_t *value, const char *name, double *number,
                                      struct fault *fault);

/* A whole number, not negative. */
enum percuss_status json_numbers_take_whole(const json_t *value, const char *name, size_t *number,
                                            struct fault *fault);

/* Whether a list may have that size; it becomes `*count`, and must be that if that is not 0. */
enum percuss_status json_numbers_check_count(size_t size, const char *name, size_t *count,
                                             struct fault *fault);

/* An array of finite numbers for free(), of `*count` if that is not 0. */
enum percuss_status json_numbers_take_array(const json_t *array, const char *name, size_t *count,
                                            double **values, struct fault *fault);

/* OK: the text member `name` of an object is that hash. */
enum percuss_status json_numbers_check_hash(const json_t *root, const char *name,
                                            const char *expected, struct fault *fault);

/* A value as text with jansson's flags, for free(); NULL: out of memory. */
char *json_numbers_text(const json_t *value, size_t flags);

#endif
