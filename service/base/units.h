/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Numbers with units, as people write them: "70 GPa", "8 mm", "2.7 g/cm^3". A number by itself is
 * in SI units. Powers of ten go into the number's own exponent before it is read, so that 9 mm is
 * to the bit what 9e-3 is. */
#ifndef PERCUSS_BASE_UNITS_H
#define PERCUSS_BASE_UNITS_H

#include <stddef.h>

/* What a number may be of. */
enum quantity {
    QUANTITY_NUMBER, /* bears no unit */
    QUANTITY_LENGTH,
    QUANTITY_STRESS,
    QUANTITY_DENSITY,
    QUANTITY_CURVATURE,
    QUANTITY_FREQUENCY,
    QUANTITY_SPEED,
    QUANTITY_TIME,
    QUANTITY_IMPULSE,
    QUANTITY_COUNT
};

enum units_problem {
    UNITS_GOOD,
    UNITS_NO_NUMBER,  /* the text does not begin with a decimal number, or is none that is finite */
    UNITS_UNKNOWN,    /* what follows the number is no unit */
    UNITS_OF_ANOTHER, /* it is one of another quantity */
};

/* Reads the whole text. The number is [+-] digits [. digits] [e [+-] digits], nothing else that
 * strtod would take, with the locale's point. -0 becomes 0. */
enum units_problem units_read(const char *text, enum quantity quantity, double *value);

/* Where the number at the beginning of the text ends; the text itself: there is none. */
const char *units_number_end(const char *text);

/* Writes what is allowed, `range` behind the quantity's name, and of a wrong unit why it is not: "a
 * speed > 0 is needed, in m/s or with a unit, such as 300 mm/s; kg is no speed". */
void units_explain(const char *text, enum units_problem problem, enum quantity quantity,
                   const char *range, char *out, size_t size);

const char *units_name(enum quantity quantity);    /* "length" */
const char *units_si(enum quantity quantity);      /* "m"; empty for a mere number */
const char *units_example(enum quantity quantity); /* "8 mm" */

/* The name of unit `number` of those known; NULL: there are no more. *prefixed: whether n, u, m,
 * c, d, k, M, G, T may stand before it. */
const char *units_known(size_t number, int *prefixed);

#endif
