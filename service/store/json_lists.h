/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The long lists of numbers in the JSON of a family of contact tables are read here, the rest by
 * jansson, which takes 2700 instructions for a number: a sixth of all that the start of a solver in
 * a program took. */
#ifndef PERCUSS_STORE_JSON_LISTS_H
#define PERCUSS_STORE_JSON_LISTS_H

#include "store/json_numbers.h"

/* More of a text are left to jansson. */
enum { JSON_LISTS_MOST = 16 };

/* Members of a text's outermost object. */
struct json_lists {
    size_t count;
    struct json_list {
        const char *name; /* in the text */
        size_t length;    /* of the name */
        size_t size;
        double *values;
    } each[JSON_LISTS_MOST];
};

/* Takes such lists out of the text, which ends with '\0' after `size` characters and is changed,
 * and parses the rest. A list that is not plain, in the way JSON writes numbers, or has one of more
 * than 15 digits is left in. The caller keeps the text until json_lists_free, which it must call
 * whatever the status, and owns the reference. */
enum percuss_status json_lists_parse(char *text, size_t size, struct json_lists *lists,
                                     json_t **root, struct fault *fault);
void json_lists_free(struct json_lists *lists);

/* A member of the outermost object, as json_numbers_take_array. */
enum percuss_status json_lists_take(struct json_lists *lists, const json_t *root, const char *name,
                                    size_t *count, double **values, struct fault *fault);

#endif
