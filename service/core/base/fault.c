/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/fault.h"

#include <stdarg.h>
#include <stdio.h>

/* Messages quote files and requests, and go to terminals and logs: control characters are
 * replaced. */
static void make_plain(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 0x7f)
            *text = '?';
}

enum percuss_status fault_set(struct fault *fault, enum percuss_status status, const char *format,
                              ...)
{
    if (fault) {
        va_list args;
        va_start(args, format);
        vsnprintf(fault->text, sizeof fault->text, format, args);
        va_end(args);
        make_plain(fault->text);
    }
    return status;
}

#define TEXT(name, text) text,
#define NAME_FUNCTION(function, list)                                                              \
    const char *function(unsigned number)                                                          \
    {                                                                                              \
        static const char *const names[] = {list(TEXT)};                                           \
        return number < sizeof names / sizeof *names ? names[number] : "?";                        \
    }

NAME_FUNCTION(status_name, PERCUSS_STATUS_LIST)
NAME_FUNCTION(end_reason_name, PERCUSS_END_REASON_LIST)
NAME_FUNCTION(contact_model_name, PERCUSS_CONTACT_MODEL_LIST)
NAME_FUNCTION(method_name, PERCUSS_METHOD_LIST)
NAME_FUNCTION(compliance_name, PERCUSS_COMPLIANCE_LIST)
NAME_FUNCTION(dents_name, PERCUSS_DENTS_LIST)
NAME_FUNCTION(friction_name, PERCUSS_FRICTION_LIST)
NAME_FUNCTION(parameter_name, PERCUSS_PARAMETER_LIST)
