/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/log_rate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/hash.h"

uint64_t log_rate_kind(const char *format, const char *message)
{
    char plain[LOG_RATE_SAMPLE];
    size_t size = 0;
    const char *at = strcmp(format, "%s") == 0 ? message : format;
    /* a run of digits counts as one */
    for (; *at && size < sizeof plain - 1; at++) {
        bool digit = *at >= '0' && *at <= '9';
        if (!digit || size == 0 || plain[size - 1] != '0')
            plain[size++] = digit ? '0' : *at;
    }
    plain[size] = '\0';
    struct hasher hasher = {0};
    hash_text(&hasher, plain);
    uint64_t kind = hash_digest(&hasher).first;
    return kind ? kind : 1;
}

static bool is_over(const struct log_kind *kind, double now)
{
    return now - kind->begun >= LOG_RATE_SECONDS;
}

/* That of the kind, or a free one, or the one that all further kinds share. A kind that waits for
 * its sum to be taken is not free. */
static struct log_kind *find(struct log_rate *rate, uint64_t kind, double now)
{
    struct log_kind *free = NULL;
    for (size_t i = 0; i < LOG_RATE_KINDS; i++) {
        struct log_kind *at = &rate->kinds[i];
        if (at->kind == kind)
            return at;
        if (!free && (!at->kind || (at->lines <= LOG_RATE_LINES && is_over(at, now))))
            free = at;
    }
    if (!free)
        return &rate->kinds[LOG_RATE_KINDS];
    *free = (struct log_kind){.kind = kind, .begun = now};
    return free;
}

bool log_rate_admits(struct log_rate *rate, uint64_t kind, enum log_level level,
                     const char *message, double now)
{
    struct log_kind *found = find(rate, kind, now);
    /* a new period where nothing of the last one is left to be told */
    if (found->lines <= LOG_RATE_LINES && is_over(found, now))
        *found = (struct log_kind){.kind = kind, .begun = now};
    if (++found->lines <= LOG_RATE_LINES)
        return true;
    if (found->lines == LOG_RATE_LINES + 1 || level < found->level)
        found->level = level;
    snprintf(found->sample, sizeof found->sample, "%s", message);
    return false;
}

/* "8,123" */
static void write_count(char text[32], unsigned long count)
{
    char digits[24];
    size_t length = (size_t)snprintf(digits, sizeof digits, "%lu", count), size = 0;
    for (size_t i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0)
            text[size++] = ',';
        text[size++] = digits[i];
    }
    text[size] = '\0';
}

bool log_rate_sum(struct log_rate *rate, double now, bool all, enum log_level *level, char *text,
                  size_t size)
{
    for (size_t i = 0; i <= LOG_RATE_KINDS; i++) {
        struct log_kind *kind = &rate->kinds[i];
        if (kind->lines <= LOG_RATE_LINES || !(all || is_over(kind, now)))
            continue;
        char count[32];
        write_count(count, kind->lines - LOG_RATE_LINES);
        *level = kind->level;
        snprintf(text, size, "and %s more in %.0f s%s: %s", count, fmax(1.0, now - kind->begun),
                 i == LOG_RATE_KINDS ? " of several kinds" : "", kind->sample);
        *kind = (struct log_kind){.kind = 0};
        return true;
    }
    return false;
}
