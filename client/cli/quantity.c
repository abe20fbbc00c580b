/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "quantity.h"

#include <stdio.h>
#include <string.h>

enum { NUMBER_SIZE = 512 };

/* "a speed > 0 is needed, in m/s or with a unit, such as 300 mm/s" */
static void allow(enum quantity quantity, const char *range, struct quantity_fault *fault)
{
    units_explain("", UNITS_GOOD, quantity, range, fault->text, sizeof fault->text);
}

bool quantity_read(const char *text, size_t length, enum quantity quantity, double *number,
                   struct quantity_fault *fault)
{
    char copy[NUMBER_SIZE];
    /* programs that print columns put blanks before numbers */
    size_t blanks = strspn(text, " \t");
    blanks = blanks < length ? blanks : length;
    snprintf(copy, sizeof copy, "%.*s", (int)(length - blanks), text + blanks);
    enum units_problem problem = units_read(copy, quantity, number);
    if (problem == UNITS_GOOD && length - blanks < sizeof copy)
        return true;
    units_explain(copy, problem, quantity, "", fault->text, sizeof fault->text);
    return false;
}

int quantity_read_list(const char *text, enum quantity quantity, double *numbers, int most,
                       struct quantity_fault *fault)
{
    for (int count = 0; count < most; text++) {
        size_t length = strcspn(text, ":");
        if (!quantity_read(text, length, quantity, &numbers[count++], fault))
            return -1;
        text += length;
        if (!*text)
            return count;
    }
    snprintf(fault->text, sizeof fault->text, "up to %d numbers are allowed", most);
    return -1;
}

double parse_quantity(const char *option, const char *text, enum quantity quantity,
                      struct argp_state *state)
{
    struct quantity_fault fault;
    double number;
    bool good = quantity_read(text, strlen(text), quantity, &number, &fault);
    if (good && number < 0.0)
        allow(quantity, " >= 0", &fault);
    if (!good || number < 0.0)
        argp_error(state, "--%s: '%s': %s", option, text, fault.text);
    return number;
}

double parse_positive_quantity(const char *option, const char *text, enum quantity quantity,
                               struct argp_state *state)
{
    struct quantity_fault fault;
    double number;
    bool good = quantity_read(text, strlen(text), quantity, &number, &fault);
    if (good && !(number > 0.0))
        allow(quantity, " > 0", &fault);
    if (!good || !(number > 0.0))
        argp_error(state, "--%s: '%s': %s", option, text, fault.text);
    return number;
}

enum quantity quantity_of(const char *name)
{
    static const struct {
        const char *name;
        enum quantity quantity;
    } known[] = {
        {"speed", QUANTITY_SPEED},    {"young", QUANTITY_STRESS},  {"yield", QUANTITY_STRESS},
        {"tangent", QUANTITY_STRESS}, {"radius", QUANTITY_LENGTH}, {"density", QUANTITY_DENSITY},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(known[i].name, name))
            return known[i].quantity;
    return QUANTITY_NUMBER;
}
