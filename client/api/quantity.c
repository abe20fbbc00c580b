/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/quantity.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "error.h"

enum { EXPLANATION_SIZE = 200 };

/* QUANTITY_COUNT: there is none of that name. */
static enum quantity quantity_named(const char *name)
{
    enum quantity quantity = QUANTITY_NUMBER;
    while (quantity < QUANTITY_COUNT && strcmp(units_name(quantity), name) != 0)
        quantity++;
    return quantity;
}

static enum percuss_result refuse_name(const char *name)
{
    char names[EXPLANATION_SIZE] = "";
    for (enum quantity one = QUANTITY_NUMBER; one < QUANTITY_COUNT; one++) {
        size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s%s", length ? ", " : "",
                 units_name(one));
    }
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "quantity: '%.40s': one of %s is allowed",
                     name, names);
}

enum percuss_result percuss_quantity_parse(const char *text, const char *quantity, double *value)
{
    if (ERROR_NULL(text, quantity, value))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    const enum quantity kind = quantity_named(quantity);
    if (kind == QUANTITY_COUNT)
        return refuse_name(quantity);
    double number;
    const char *begin = text + strspn(text, " \t");
    const enum units_problem problem = units_read(begin, kind, &number);
    if (problem == UNITS_GOOD) {
        *value = number;
        return PERCUSS_RESULT_OK;
    }
    char why[EXPLANATION_SIZE];
    units_explain(begin, problem, kind, "", why, sizeof why);
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "'%.60s': %s", text, why);
}
