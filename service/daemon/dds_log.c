/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/dds_log.h"

#include <dds/ddsrt/log.h>
#include <stdbool.h>
#include <string.h>

#include "daemon/log.h"

/* The first line says what happened; what security plugins add below are traces of libraries. */
static void take_line(void *context, const dds_log_data_t *data)
{
    (void)context;
    bool is_error = data->priority & (DDS_LC_FATAL | DDS_LC_ERROR);
    log_line(is_error ? LEVEL_ERROR : LEVEL_WARNING, "DDS: %.*s", (int)strcspn(data->message, "\n"),
             data->message);
}

void dds_log_begin(void)
{
    dds_set_log_sink(take_line, NULL);
}
