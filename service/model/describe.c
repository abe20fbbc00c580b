/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/describe.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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
