/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "quantity.h"

#include <stdio.h>
#include <string.h>

enum { NUMBER_SIZE = 512 };

/* "a speed > 0 is needed, in m/s or with a unit, such as 300 mm/s" */
static void allow(enum quantity quantity, const char *range, struct quantity_fault *fault)
{
    const char *si = units_si(quantity);
    if (*si)
        snprintf(fault->text, sizeof fault->text,
                 "a %s%s is needed, in %s or with a unit, such as %s", units_name(quantity), range,
                 si, units_example(quantity));
    else
        snprintf(fault->text, sizeof fault->text, "a number%s is needed, without a unit", range);
}

/* Goes on with what the unit of `text` is not. */
static void blame_unit(const char *text, enum quantity quantity, enum units_problem problem,
                       struct quantity_fault *fault)
{
    const char *unit = units_number_end(text);
    size_t length = strlen(fault->text);
    unit += strspn(unit, " ");
    snprintf(fault->text + length, sizeof fault->text - length, "; %.40s is no %s", unit,
             problem == UNITS_UNKNOWN ? "unit that is known" : units_name(quantity));
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
    /* what is allowed, and of a unit why it is not */
    allow(quantity, "", fault);
    if (*units_si(quantity) && (problem == UNITS_UNKNOWN || problem == UNITS_OF_ANOTHER))
        blame_unit(copy, quantity, problem, fault);
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
