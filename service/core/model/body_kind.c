/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body_kind.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define ADDRESS(kind) &kind##_kind,
static const struct body_kind *const kinds[] = {BODY_KINDS(ADDRESS) NULL};

const struct body_kind *body_kind_at(size_t number)
{
    return number < sizeof kinds / sizeof *kinds ? kinds[number] : NULL;
}

size_t body_kind_number(const struct body_kind *kind)
{
    size_t number = 0;
    while (kinds[number] && kinds[number] != kind)
        number++;
    return number;
}

void describe_add(struct body_description *description, const char *format, ...)
{
    char *text = description->text;
    size_t used = strlen(text);
    if (used > 0 && used + 3 < sizeof description->text) {
        memcpy(text + used, ", ", 3);
        used += 2;
    }
    va_list args;
    va_start(args, format);
    vsnprintf(text + used, sizeof description->text - used, format, args);
    va_end(args);
}

void describe_extents(struct body_description *description, double x, double y, double z)
{
    description->half_extents[0] = x;
    description->half_extents[1] = y;
    description->half_extents[2] = z;
}
