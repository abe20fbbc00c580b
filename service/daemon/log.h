/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines on stderr: time, level, whom it is about, message. */
#ifndef PERCUSS_DAEMON_LOG_H
#define PERCUSS_DAEMON_LOG_H

#include <stdbool.h>
#include <stdint.h>

#include "respond/settings.h"

/* Messages above this level are left out; at first everything but LEVEL_DEBUG is written. */
void log_limit(enum log_level level);

/* Whether messages of this level are written. */
bool log_shows(enum log_level level);

/* LOG_TEXT at first. Before there are threads. */
void log_use(enum log_format format);

/* From now on LOG_RATE_LINES of a kind are written a minute, and the others are summed up; not at
 * the debug level. Before there are threads. */
void log_limit_rate(void);

/* Tells how many lines were left out, of kinds whose minute is over, or of `all`. Once a second and
 * at the end. Thread-safe. */
void log_sum_up(bool all);

/* One line; control characters in it become spaces. Thread-safe. */
void log_line(enum log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Whose request a line is about. */
struct log_request {
    const uint8_t *client; /* 16 octets, borrowed */
    uint64_t sequence;
};

/* Likewise, about a request: "client HEX request N: " goes before the message, in JSON as members
 * of their own. */
void log_about(enum log_level level, const struct log_request *request, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
