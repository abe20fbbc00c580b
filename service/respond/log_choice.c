/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/log_choice.h"

const char *log_level_name(enum log_level level)
{
    static const char *const names[LEVEL_COUNT] = {"error", "warning", "info", "debug"};
    return names[level];
}

const char *log_format_name(enum log_format format)
{
    static const char *const names[LOG_FORMAT_COUNT] = {"text", "journal", "json"};
    return names[format];
}
