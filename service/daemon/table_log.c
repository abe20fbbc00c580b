/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/table_log.h"

#include "daemon/log.h"

static void left_out(const struct fault *fault)
{
    log_line(LEVEL_WARNING, "table left out: %s", fault->text);
}

static void told(bool warning, const char *text)
{
    log_line(warning ? LEVEL_WARNING : LEVEL_INFO, "%s", text);
}

const struct table_listener table_log = {left_out, told};
