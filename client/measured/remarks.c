/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "remarks.h"

#include <stdarg.h>
#include <stdio.h>

/* Text of a file goes to a terminal. */
static void write_line(struct measured_fault *fault, const char *format, va_list arguments)
{
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    for (char *c = fault->text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f)
            *c = '?';
}

bool measured_fail(struct measured_fault *fault, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    write_line(fault, format, arguments);
    va_end(arguments);
    return false;
}

bool remarks_wrong(struct measured_remarks *remarks, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (remarks->errors < REMARKS_KEPT)
        write_line(&remarks->error[remarks->errors], format, arguments);
    va_end(arguments);
    remarks->errors++;
    return false;
}

void remarks_note(struct measured_remarks *remarks, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (remarks->notes < REMARKS_KEPT)
        write_line(&remarks->note[remarks->notes], format, arguments);
    va_end(arguments);
    remarks->notes++;
}
