/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "error.h"

#include <stdarg.h>
#include <stdio.h>

/* Per thread: a client may be shared by threads, and a client that could not be created has no
 * place for a text. */
static _Thread_local char error_text[768];

enum percuss_result error_set(enum percuss_result result, const char *format, ...)
{
    const char *lack = result == PERCUSS_RESULT_NO_MEMORY ? "out of memory: " : "";
    int length = snprintf(error_text, sizeof error_text, "%s", lack);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text + length, sizeof error_text - (size_t)length, format, arguments);
    va_end(arguments);
    return result;
}

enum percuss_result error_null(struct missing missing)
{
    return missing.name
               ? error_set(PERCUSS_RESULT_INVALID_ARGUMENT, MISSING_FORMAT, MISSING_TEXT(missing))
               : PERCUSS_RESULT_OK;
}

void error_copy(const char *text)
{
    snprintf(error_text, sizeof error_text, "%s", text);
}

const char *error_last(void)
{
    return error_text;
}

const char *percuss_error_text(void)
{
    return error_text;
}
