/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Limits how often lines of one kind are logged, so that no fault that repeats fills a disk. It has
 * no clock: times are monotonic, s. One thread at a time. */
#ifndef PERCUSS_DAEMON_LOG_RATE_H
#define PERCUSS_DAEMON_LOG_RATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "respond/settings.h"

enum {
    LOG_RATE_LINES = 20,   /* of a kind that are written in a period */
    LOG_RATE_SECONDS = 60, /* a period, from the first line of a kind on */
    LOG_RATE_KINDS = 64,   /* at a time; lines of further kinds share one limit */
    LOG_RATE_SAMPLE = 200  /* bytes */
};

struct log_rate {
    struct log_kind {
        uint64_t kind; /* 0: none */
        double begun;
        unsigned long lines;
        enum log_level level;         /* the gravest of the lines that were left out */
        char sample[LOG_RATE_SAMPLE]; /* the last of them */
    } kinds[LOG_RATE_KINDS + 1];
};

/* Lines of different kinds differ in more than numbers: the format tells, or the message where the
 * format is "%s". */
uint64_t log_rate_kind(const char *format, const char *message);

/* Whether a line is written. False: it is counted. */
bool log_rate_admits(struct log_rate *rate, uint64_t kind, enum log_level level,
                     const char *message, double now);

/* Takes the sum of a kind whose period is over (`all`: of any kind) and that has left lines out, as
 * "and 8,123 more in 60 s: MESSAGE" in `text`. False: there is none. */
bool log_rate_sum(struct log_rate *rate, double now, bool all, enum log_level *level, char *text,
                  size_t size);

#endif
