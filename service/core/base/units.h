/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbers with units, such as "70 GPa", "8 mm", "2.7 g/cm^3". A number without a unit is in SI
 * units. Powers of ten are added to the number's exponent before it is converted, so that 9 mm
 * equals 9e-3 to the bit. */
#ifndef PERCUSS_BASE_UNITS_H
#define PERCUSS_BASE_UNITS_H

#include <stddef.h>

enum quantity {
    QUANTITY_NUMBER, /* without a unit */
    QUANTITY_LENGTH,
    QUANTITY_STRESS,
    QUANTITY_DENSITY,
    QUANTITY_CURVATURE,
    QUANTITY_FREQUENCY,
    QUANTITY_SPEED,
    QUANTITY_TIME,
    QUANTITY_IMPULSE,
    QUANTITY_ACCELERATION, /* g alone is 9.80665 m/s^2, not a gram */
    QUANTITY_COUNT
};

enum units_problem {
    UNITS_GOOD,
    UNITS_NO_NUMBER,  /* the text does not begin with a finite decimal number */
    UNITS_UNKNOWN,    /* no known unit follows the number */
    UNITS_OF_ANOTHER, /* the unit belongs to another quantity */
};

/* Reads the whole text. The number is [+-] digits [. digits] [e [+-] digits], with the locale's
 * point; no other form that strtod accepts. -0 becomes 0. */
enum units_problem units_read(const char *text, enum quantity quantity, double *value);

/* End of the number at the beginning of the text; the text itself: there is none. */
const char *units_number_end(const char *text);

/* Writes the allowed values, with `range` behind the quantity's name, and the reason why a unit is
 * refused: "a speed > 0 is needed, in m/s or with a unit, such as 300 mm/s; kg is no speed". */
void units_explain(const char *text, enum units_problem problem, enum quantity quantity,
                   const char *range, char *out, size_t size);

const char *units_name(enum quantity quantity);    /* "length" */
const char *units_si(enum quantity quantity);      /* "m"; empty for QUANTITY_NUMBER */
const char *units_example(enum quantity quantity); /* "8 mm" */

/* The name of known unit `number`; NULL: there are no more. *prefixed: the prefixes n, u, m, c, d,
 * k, M, G, T are allowed. */
const char *units_known(size_t number, int *prefixed);

/* The prefix `number`; NULL: there are no more. */
const char *units_prefix(size_t number);

#endif
