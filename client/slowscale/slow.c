/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "slow.h"

#include <stdarg.h>
#include <stdio.h>

/* Per thread, as in libpercuss: an object that was not created has no place for a text. */
static _Thread_local char error_text[512];

enum percuss_result slow_fail(enum percuss_result result, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text, sizeof error_text, format, arguments);
    va_end(arguments);
    return result;
}

enum percuss_result slow_null(struct missing missing)
{
    return missing.name
               ? slow_fail(PERCUSS_RESULT_INVALID_ARGUMENT, MISSING_FORMAT, MISSING_TEXT(missing))
               : PERCUSS_RESULT_OK;
}

enum percuss_result slow_no_memory(void)
{
    return slow_fail(PERCUSS_RESULT_NO_MEMORY, "no memory for an impact");
}

const char *percuss_slow_error_text(void)
{
    return error_text;
}
