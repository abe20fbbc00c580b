/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines on stderr: time, level, message. */
#ifndef PERCUSS_DAEMON_LOG_H
#define PERCUSS_DAEMON_LOG_H

enum log_level { LEVEL_ERROR, LEVEL_WARNING, LEVEL_INFO, LEVEL_DEBUG, LEVEL_COUNT };

/* Messages above this level are left out; at first everything but LEVEL_DEBUG is written. */
void log_limit(enum log_level level);

/* One line; control characters in it become spaces. Thread-safe. */
void log_line(enum log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* "error", "warning", ... */
const char *log_level_name(enum log_level level);

#endif
