/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The variables of an FMU: one table, of which modelDescription.xml is made and by which values are
 * got and set. A variable's place in the table is its value reference. */
#ifndef PERCUSS_FMI_VARIABLE_H
#define PERCUSS_FMI_VARIABLE_H

#include <stdbool.h>
#include <stddef.h>

/* A text variable, with its terminating zero: paths are the longest. */
enum { VARIABLE_TEXT_SIZE = 512 };

enum variable_type { VARIABLE_FLOAT64, VARIABLE_INT32, VARIABLE_BOOLEAN, VARIABLE_STRING };

enum variable_role {
    VARIABLE_TIME,
    VARIABLE_PARAMETER, /* set before the simulation */
    VARIABLE_INPUT,
    VARIABLE_STATE,      /* continuous output that has a start value */
    VARIABLE_DERIVATIVE, /* of the state before it in the table */
    VARIABLE_INDICATOR,  /* of events */
    VARIABLE_CONTINUOUS, /* output */
    VARIABLE_DISCRETE    /* output that changes at events */
};

struct variable {
    const char *name;
    enum variable_role role;
    enum variable_type type;
    const char *unit;    /* of those in describe.c; NULL: none */
    size_t offset;       /* in the model's numbers */
    double start;        /* of numbers and booleans, where it is not calculated */
    const char *text;    /* the start of a text */
    const char *meaning; /* description */
};

/* Whether the value is the importer's to begin with. */
static inline bool variable_has_start(const struct variable *variable)
{
    return variable->role == VARIABLE_PARAMETER || variable->role == VARIABLE_INPUT ||
           variable->role == VARIABLE_STATE;
}

#endif
