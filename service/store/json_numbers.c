/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/json_numbers.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_VALUES = 1000000 };

json_t *json_numbers(size_t count, const double *values)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++) {
        if (json_array_append_new(array, json_real(values[i])) != 0) {
            json_decref(array);
            return NULL;
        }
    }
    return array;
}

enum percuss_status json_numbers_parse(const char *text, size_t size, json_t **root,
                                       struct fault *fault)
{
    json_error_t error;
    *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (*root)
        return PERCUSS_OK;
    /* without memory jansson's reader sets no line, or has this code */
    if (error.line < 0 || json_error_code(&error) == json_error_out_of_memory)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    return fault_set(fault, PERCUSS_BAD_REQUEST, "line %d: must be JSON: %s", error.line,
                     error.text);
}

enum percuss_status json_numbers_take(const json_t *value, const char *name, double *number,
                                      struct fault *fault)
{
    *number = json_is_number(value) ? json_number_value(value) : NAN;
    if (isfinite(*number))
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: must be a number", name);
}

enum percuss_status json_numbers_take_whole(const json_t *value, const char *name, size_t *number,
                                            struct fault *fault)
{
    json_int_t whole = json_is_integer(value) ? json_integer_value(value) : -1;
    *number = (size_t)whole;
    if (whole >= 0 && whole <= UINT32_MAX)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: must be a whole number, not negative", name);
}

enum percuss_status json_numbers_check_count(size_t size, const char *name, size_t *count,
                                             struct fault *fault)
{
    if (size == 0 || size > MOST_VALUES || (*count && size != *count))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %zu values: must be %s", name, size,
                         *count ? "as many as those beside it" : "1 to 1000000");
    *count = size;
    return PERCUSS_OK;
}

enum percuss_status json_numbers_take_array(const json_t *array, const char *name, size_t *count,
                                            double **values, struct fault *fault)
{
    size_t size = json_array_size(array);
    enum percuss_status status = json_numbers_check_count(size, name, count, fault);
    if (status)
        return status;
    *values = calloc(size, sizeof **values);
    if (!*values)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t i = 0; i < size && !status; i++)
        status = json_numbers_take(json_array_get(array, i), name, &(*values)[i], fault);
    return status;
}

enum percuss_status json_numbers_check_hash(const json_t *root, const char *name,
                                            const char *expected, struct fault *fault)
{
    const char *text = json_string_value(json_object_get(root, name));
    if (text && strcmp(text, expected) == 0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %.40s: must be %s: the file is damaged", name,
                     text ? text : "missing", expected);
}

char *json_numbers_text(const json_t *value, size_t flags)
{
    /* json_dumps of jansson 2.14 loses a key where its buffer cannot grow */
    size_t size = json_dumpb(value, NULL, 0, flags);
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
