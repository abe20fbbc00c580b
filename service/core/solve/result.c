/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/result.h"

#include <stdarg.h>
#include <stdio.h>

/* Places that kinds not found yet may need. */
static size_t reserved(const struct warnings *warnings)
{
    size_t places = WARNING_KINDS;
    for (unsigned kinds = warnings->kinds; kinds; kinds &= kinds - 1)
        places--;
    return places;
}

/* The next text's place, noted as of that kind; NULL: there is none for it. */
static char *next_text(struct warnings *warnings, enum warning_kind kind)
{
    uint32_t bit = UINT32_C(1) << kind;
    bool again = warnings->kinds & bit;
    if (again && warnings->count + reserved(warnings) >= WARNINGS_ROOM)
        return NULL;
    warnings->kinds |= bit;
    warnings->kind[warnings->count] = kind;
    return warnings->text[warnings->count++];
}

void warnings_add(struct warnings *warnings, enum warning_kind kind, const char *format, ...)
{
    char *text = next_text(warnings, kind);
    if (!text)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(text, WARNING_SIZE, format, args);
    va_end(args);
}

bool warnings_begin(struct warnings *warnings, enum warning_kind kind, struct text *text)
{
    char *buffer = next_text(warnings, kind);
    if (buffer)
        *text = text_begin(buffer, WARNING_SIZE);
    return buffer;
}

const char *warnings_text(const struct warnings *warnings, enum warning_kind kind)
{
    for (size_t i = 0; i < warnings->count; i++)
        if (warnings->kind[i] == kind)
            return warnings->text[i];
    return NULL;
}
