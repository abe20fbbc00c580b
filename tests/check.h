/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What every test has: cmocka with the headers that it asks for, and comparisons of numbers, which
 * PERCUSS_MEASURE=1 prints. */
#ifndef PERCUSS_TEST_CHECK_H
#define PERCUSS_TEST_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* Whether |value - expected| <= allowed, infinities being equal; says so where it is not. */
static inline bool is_near(const char *what, double value, double expected, double allowed)
{
    double error = value == expected ? 0.0 : fabs(value - expected);
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %-44s %.12g expected %.12g error %.2e allowed %.1e\n", what, value,
                      expected, error, allowed);
    if (error <= allowed)
        return true;
    print_error("%s: %.17g is not %.17g within %g (error %.3e)\n", what, value, expected, allowed,
                error);
    return false;
}

/* The same with a part of |expected|. */
static inline bool is_near_relative(const char *what, double value, double expected,
                                    double relative)
{
    return is_near(what, value, expected, relative * fabs(expected));
}

/* Fail the test at this line unless |value - expected| is at most: allowed; relative |expected|;
 * relative |scale|. The first two are told what the value is, the others show its expression. */
#define measured(what, value, expected, allowed)                                                   \
    ((void)(is_near(what, value, expected, allowed) || (fail(), 0)))
#define measured_relative(what, value, expected, relative)                                         \
    ((void)(is_near_relative(what, value, expected, relative) || (fail(), 0)))
#define near(value, expected, allowed) measured(#value, value, expected, allowed)
#define near_relative(value, expected, relative)                                                   \
    measured_relative(#value, value, expected, relative)
#define near_scaled(value, expected, scale, relative)                                              \
    measured(#value, value, expected, (relative)*fabs(scale))

#endif
