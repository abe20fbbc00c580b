/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Checks of foreign values, one after the other; the first that fails writes the message "PLACE:
 * VALUE: must be ALLOWED" and later ones say nothing. */
#ifndef PERCUSS_EXCHANGE_CHECK_H
#define PERCUSS_EXCHANGE_CHECK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"

struct check {
    enum percuss_status status; /* PERCUSS_OK or PERCUSS_BAD_REQUEST */
    struct fault *fault;
    const char *place; /* what the fields belong to; NULL: the request itself */
    size_t index;      /* in it; CHECK_NO_LIST: it is no list */
};

#define CHECK_NO_LIST SIZE_MAX

/* Sets the place to "NAME[INDEX]" or "NAME"; the name stays the caller's and must outlive the
 * checks of this place. Nothing is put into words before a check fails: most requests are good. */
void check_enter(struct check *check, const char *name, size_t index);

/* Finite and within low .. high. */
void check_range(struct check *check, const char *field, double value, double low, double high);

/* The same, or 0 for the default. */
void check_range_or_zero(struct check *check, const char *field, double value, double low,
                         double high);

/* Three finite numbers of magnitude at most `limit`. */
void check_vector(struct check *check, const char *field, const double vector[3], double limit);

/* A unit vector of 3 or 4 numbers to 1e-4; `unit` receives it normalised. */
void check_unit(struct check *check, const char *field, const double *vector, size_t size,
                double *unit);

/* A number below `count`, with the names of what is allowed. */
void check_choice(struct check *check, const char *field, unsigned value, unsigned count,
                  const char *(*name)(unsigned));

/* Text in UTF-8 without control characters. */
void check_text(struct check *check, const char *field, const char *text);

/* Anything else: the message is written if `good` is false. */
void check_that(struct check *check, bool good, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
