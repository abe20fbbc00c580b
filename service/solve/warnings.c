/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/warnings.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

/* Places that kinds not found yet may need. */
static size_t reserved(const struct warnings *warnings)
{
    size_t places = WARNING_KINDS;
    for (unsigned kinds = warnings->kinds; kinds; kinds &= kinds - 1)
        places--;
    return places;
}

void warnings_add(struct warnings *warnings, enum warning_kind kind, const char *format, ...)
{
    uint32_t bit = UINT32_C(1) << kind;
    bool again = warnings->kinds & bit;
    if (again && warnings->count + reserved(warnings) >= WARNINGS_ROOM)
        return;
    va_list args;
    va_start(args, format);
    warnings->kinds |= bit;
    warnings->kind[warnings->count] = kind;
    vsnprintf(warnings->text[warnings->count++], WARNING_SIZE, format, args);
    va_end(args);
}

const char *warnings_text(const struct warnings *warnings, enum warning_kind kind)
{
    for (size_t i = 0; i < warnings->count; i++)
        if (warnings->kind[i] == kind)
            return warnings->text[i];
    return NULL;
}
