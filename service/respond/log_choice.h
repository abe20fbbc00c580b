/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What may be chosen of a log: how much of it, and in which form. */
#ifndef PERCUSS_RESPOND_LOG_CHOICE_H
#define PERCUSS_RESPOND_LOG_CHOICE_H

enum log_level { LEVEL_ERROR, LEVEL_WARNING, LEVEL_INFO, LEVEL_DEBUG, LEVEL_COUNT };

/* For people, for the journal of systemd (which has its own clock, and takes the level as "<N>"),
 * and one JSON object a line. */
enum log_format { LOG_TEXT, LOG_JOURNAL, LOG_JSON, LOG_FORMAT_COUNT };

/* "error", "warning", ... */
const char *log_level_name(enum log_level level);

/* "text", "journal", "json" */
const char *log_format_name(enum log_format format);

#endif
