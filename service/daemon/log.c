/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/log.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static atomic_int limit = LEVEL_INFO;

void log_limit(enum log_level level)
{
    atomic_store(&limit, (int)level);
}

const char *log_level_name(enum log_level level)
{
    static const char *const names[LEVEL_COUNT] = {"error", "warning", "info", "debug"};
    return names[level];
}

static size_t write_head(char *line, size_t size, enum log_level level)
{
    struct timespec now;
    struct tm parts;
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &parts);
    size_t used = strftime(line, size, "%Y-%m-%dT%H:%M:%S", &parts);
    used += (size_t)snprintf(line + used, size - used, ".%03ldZ %-7s ", now.tv_nsec / 1000000,
                             log_level_name(level));
    return used;
}

void log_line(enum log_level level, const char *format, ...)
{
    char line[1200];
    if ((int)level > atomic_load(&limit))
        return;
    size_t used = write_head(line, sizeof line, level);
    va_list args;
    va_start(args, format);
    int length = vsnprintf(line + used, sizeof line - used - 1, format, args);
    va_end(args);
    /* what does not fit is cut off, and no control character breaks the line */
    size_t room = sizeof line - used - 2;
    size_t end = used + (length < 0 ? 0 : (size_t)length < room ? (size_t)length : room);
    for (size_t i = used; i < end; i++) {
        if ((unsigned char)line[i] < 0x20)
            line[i] = ' ';
    }
    line[end++] = '\n';
    /* one write a line, so that lines of several threads do not mix */
    ssize_t written = write(STDERR_FILENO, line, end);
    (void)written;
}
