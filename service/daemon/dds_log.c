/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/dds_log.h"

#include <dds/ddsrt/log.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>

#include "daemon/log.h"

/* Lines that pass from one report to the next: anybody who reaches a port can cause them. */
static const unsigned MOST_LINES = 5, CALLS_OF_REPORT = 10;

/* Of the process, as the log of DDS is. */
static atomic_uint lines, calls;

/* The first line says what happened; what security plugins add below are traces of libraries. */
static void take_line(void *context, const dds_log_data_t *data)
{
    (void)context;
    if (atomic_fetch_add(&lines, 1) >= MOST_LINES)
        return;
    bool is_error = data->priority & (DDS_LC_FATAL | DDS_LC_ERROR);
    log_line(is_error ? LEVEL_ERROR : LEVEL_WARNING, "DDS: %.*s", (int)strcspn(data->message, "\n"),
             data->message);
}

void dds_log_begin(void)
{
    dds_set_log_sink(take_line, NULL);
}

void dds_log_report(void)
{
    if (atomic_fetch_add(&calls, 1) % CALLS_OF_REPORT)
        return;
    unsigned said = atomic_exchange(&lines, 0);
    if (said > MOST_LINES)
        log_line(LEVEL_WARNING, "DDS: %u more such lines", said - MOST_LINES);
}
