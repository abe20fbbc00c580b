/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Lines on stderr: time, level, the request that they are about, message. The number of lines of a
 * kind is limited, so that no error that repeats fills a disk. */
#ifndef PERCUSS_DAEMON_LOG_H
#define PERCUSS_DAEMON_LOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "respond/settings.h"

/* Messages above this level are left out; at first all but those of LEVEL_DEBUG are written. */
void log_limit(enum log_level level);

/* Whether messages of this level are written. */
bool log_shows(enum log_level level);

/* LOG_TEXT at first. Before there are threads. */
void log_use(enum log_format format);

/* From now on LOG_RATE_LINES of a kind are written a minute, and the others are summed up; not at
 * the debug level. Before there are threads. */
void log_limit_rate(void);

/* From now on the messages of Cyclone DDS go into the log: most of them are about malformed packets
 * and unknown participants, and any host that reaches a port can cause them. Before the first
 * entity of DDS. */
void log_take_dds(void);

/* Logs the number of lines that were left out, of kinds with a minute that is over, or of `all`.
 * Once a second and at the end. Thread-safe. */
void log_sum_up(bool all);

/* One line; control characters in it become spaces. Thread-safe. */
void log_line(enum log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The request that a line is about. */
struct log_request {
    const uint8_t *client; /* 16 octets, borrowed */
    uint64_t sequence;
};

/* Likewise, about a request: "client HEX request N: " goes before the message, in JSON as members
 * of their own. */
void log_about(enum log_level level, const struct log_request *request, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The limit by itself, without a clock: times are monotonic, s. One thread at a time. */
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

/* The kind of a line: by its format, or its message where the format is "%s", without the numbers.
 */
uint64_t log_rate_kind(const char *format, const char *message);

/* Whether a line is written. False: it is counted. */
bool log_rate_admits(struct log_rate *rate, uint64_t kind, enum log_level level,
                     const char *message, double now);

/* Takes the sum of a kind that has left lines out and has its period over (`all`: of any kind), as
 * "and 8,123 more in 60 s: MESSAGE" in `text`. False: there is none. */
bool log_rate_sum(struct log_rate *rate, double now, bool all, enum log_level *level, char *text,
                  size_t size);

#endif
