/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines on stderr: time, level, whom it is about, message. */
#ifndef PERCUSS_DAEMON_LOG_H
#define PERCUSS_DAEMON_LOG_H

#include <stdbool.h>
#include <stdint.h>

enum log_level { LEVEL_ERROR, LEVEL_WARNING, LEVEL_INFO, LEVEL_DEBUG, LEVEL_COUNT };

/* For people, for the journal of systemd (which has its own clock, and takes the level as "<N>"),
 * and one JSON object a line. */
enum log_format { LOG_TEXT, LOG_JOURNAL, LOG_JSON, LOG_FORMAT_COUNT };

/* Messages above this level are left out; at first everything but LEVEL_DEBUG is written. */
void log_limit(enum log_level level);

/* Whether messages of this level are written. */
bool log_shows(enum log_level level);

/* LOG_TEXT at first. Before there are threads. */
void log_use(enum log_format format);

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

/* "error", "warning", ... */
const char *log_level_name(enum log_level level);

/* "text", "journal", "json" */
const char *log_format_name(enum log_format format);

#endif
