/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/check.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* How far from 1 the norm of a unit vector may be. */
static const double UNIT_TOLERANCE = 1e-4;

void check_enter(struct check *check, const char *name, size_t index)
{
    check->place = name;
    check->index = index;
}

void check_that(struct check *check, bool good, const char *format, ...)
{
    if (good || check->status)
        return;
    char message[sizeof check->fault->text], place[32] = "";
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (check->place && check->index == CHECK_NO_LIST)
        snprintf(place, sizeof place, "%s.", check->place);
    else if (check->place)
        snprintf(place, sizeof place, "%s[%zu].", check->place, check->index);
    check->status = fault_set(check->fault, PERCUSS_BAD_REQUEST, "%s%s", place, message);
}

static bool is_within(double value, double low, double high)
{
    return value >= low && value <= high; /* false for NaN */
}

void check_range(struct check *check, const char *field, double value, double low, double high)
{
    check_that(check, is_within(value, low, high), "%s: %g: must be in [%g, %g]", field, value, low,
               high);
}

void check_range_or_zero(struct check *check, const char *field, double value, double low,
                         double high)
{
    check_that(check, value == 0.0 || is_within(value, low, high),
               "%s: %g: must be 0 (the default) or in [%g, %g]", field, value, low, high);
}

struct vector_text {
    char text[128];
};

static struct vector_text vector_text(const double *vector, size_t size)
{
    struct vector_text list = {"("};
    size_t used = 1;
    for (size_t i = 0; i < size && used < sizeof list.text; i++)
        used += (size_t)snprintf(list.text + used, sizeof list.text - used, "%g%s", vector[i],
                                 i + 1 < size ? ", " : ")");
    return list;
}

void check_vector(struct check *check, const char *field, const double vector[3], double limit)
{
    bool good = true;
    for (size_t i = 0; i < 3; i++)
        good = good && is_within(vector[i], -limit, limit);
    if (!good)
        check_that(check, false, "%s: %s: each must be in [%g, %g]", field,
                   vector_text(vector, 3).text, -limit, limit);
}

void check_unit(struct check *check, const char *field, const double *vector, size_t size,
                double *unit)
{
    double square = 0.0;
    for (size_t i = 0; i < size; i++)
        square += vector[i] * vector[i];
    double norm = sqrt(square);
    if (!(fabs(norm - 1.0) <= UNIT_TOLERANCE))
        check_that(check, false, "%s: %s: must be a unit %s (norm within %g of 1)", field,
                   vector_text(vector, size).text, size == 4 ? "quaternion (w, x, y, z)" : "vector",
                   UNIT_TOLERANCE);
    for (size_t i = 0; i < size; i++)
        unit[i] = vector[i] / norm;
}

void check_choice(struct check *check, const char *field, unsigned value, unsigned count,
                  const char *(*name)(unsigned))
{
    char list[256] = "";
    size_t used = 0;
    for (unsigned i = 0; value >= count && i < count && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%u (%s)", i ? ", " : "", i,
                                 name(i));
    check_that(check, value < count, "%s: %u: must be one of %s", field, value, list);
}

/* Bytes of the UTF-8 character at `text`; 0: none, or a control character. */
static size_t character_size(const unsigned char *text)
{
    /* forms of one to four octets (RFC 3629): how the first begins, and the least code of each */
    static const struct {
        unsigned char mask, lead;
        unsigned least; /* longer than needed is not UTF-8 */
    } forms[] = {
        {0x80, 0x00, 0x20}, {0xe0, 0xc0, 0xa0}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};
    for (size_t extra = 0; extra < 4; extra++) {
        if ((text[0] & forms[extra].mask) != forms[extra].lead)
            continue;
        /* six bits of the code from each octet that follows */
        unsigned code = text[0] & (unsigned char)~forms[extra].mask;
        for (size_t i = 1; i <= extra; i++) {
            if ((text[i] & 0xc0) != 0x80)
                return 0;
            code = code << 6 | (text[i] & 0x3f);
        }
        /* neither a control character nor half of a UTF-16 pair */
        bool surrogate = code >= 0xd800 && code < 0xe000;
        bool allowed = code >= forms[extra].least && code != 0x7f && code < 0x110000;
        return allowed && !surrogate ? extra + 1 : 0;
    }
    return 0;
}

void check_text(struct check *check, const char *field, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    while (*at && character_size(at))
        at += character_size(at);
    check_that(check, !*at, "%s: byte 0x%02x at %td: must be UTF-8 without control characters",
               field, *at, (const char *)at - text);
}
