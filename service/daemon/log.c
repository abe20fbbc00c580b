/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/log.h"

#include <dds/ddsrt/log.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/text.h"
#include "exchange/clock.h"

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

static bool log_rate_is_over(const struct log_kind *kind, double now)
{
    return now - kind->begun >= LOG_RATE_SECONDS;
}

/* The entry of the kind, or a free one, or the one that all further kinds share. An entry is not
 * free while its sum is not taken. */
static struct log_kind *log_rate_find(struct log_rate *rate, uint64_t kind, double now)
{
    struct log_kind *free = NULL;
    for (size_t i = 0; i < LOG_RATE_KINDS; i++) {
        struct log_kind *at = &rate->kinds[i];
        if (at->kind == kind)
            return at;
        if (!free && (!at->kind || (at->lines <= LOG_RATE_LINES && log_rate_is_over(at, now))))
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
    struct log_kind *found = log_rate_find(rate, kind, now);
    /* a new period where the last one has no sum */
    if (found->lines <= LOG_RATE_LINES && log_rate_is_over(found, now))
        *found = (struct log_kind){.kind = kind, .begun = now};
    if (++found->lines <= LOG_RATE_LINES)
        return true;
    if (found->lines == LOG_RATE_LINES + 1 || level < found->level)
        found->level = level;
    snprintf(found->sample, sizeof found->sample, "%s", message);
    return false;
}

/* "8,123" */
static void log_rate_write_count(char text[32], unsigned long count)
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
        if (kind->lines <= LOG_RATE_LINES || !(all || log_rate_is_over(kind, now)))
            continue;
        char count[32];
        log_rate_write_count(count, kind->lines - LOG_RATE_LINES);
        *level = kind->level;
        snprintf(text, size, "and %s more in %.0f s%s: %s", count, fmax(1.0, now - kind->begun),
                 i == LOG_RATE_KINDS ? " of several kinds" : "", kind->sample);
        *kind = (struct log_kind){.kind = 0};
        return true;
    }
    return false;
}

/* Bytes: of a message; of a line, in which JSON writes a byte as six at most. */
enum { MESSAGE_SIZE = 1200, LINE_SIZE = 6 * MESSAGE_SIZE + 200, ID_SIZE = 33 };

static atomic_int limit = LEVEL_INFO;
static enum log_format used_format = LOG_TEXT;

/* Of the process, as stderr is. */
static bool rate_is_limited;
static struct log_rate rate;
static pthread_mutex_t rate_lock = PTHREAD_MUTEX_INITIALIZER;

void log_limit(enum log_level level)
{
    atomic_store(&limit, (int)level);
}

bool log_shows(enum log_level level)
{
    return (int)level <= atomic_load(&limit);
}

void log_use(enum log_format format)
{
    used_format = format;
}

void log_limit_rate(void)
{
    rate_is_limited = true;
}

/* "2026-11-22T22:21:05.123Z" */
static void log_write_time(struct text *line)
{
    char seconds[32];
    struct timespec now;
    struct tm parts;
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &parts);
    strftime(seconds, sizeof seconds, "%Y-%m-%dT%H:%M:%S", &parts);
    text_format(line, "%s.%03ldZ", seconds, now.tv_nsec / 1000000);
}

static void log_write_id(char id[ID_SIZE], const uint8_t client[16])
{
    for (int i = 0; i < 16; i++)
        snprintf(id + 2 * i, 3, "%02x", client[i]);
}

/* Octets of the UTF-8 character at `text`, which ends with a zero; 0: it is none. */
static int character_length(const unsigned char *text)
{
    static const unsigned smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    int length = *text < 0x80 ? 1 : *text >> 5 == 6 ? 2 : *text >> 4 == 14 ? 3 : 4;
    if (length == 1)
        return 1;
    if (length == 4 && *text >> 3 != 30)
        return 0;
    /* six bits from each octet that follows */
    unsigned value = *text & (0x7fu >> length);
    for (int i = 1; i < length; i++) {
        if (text[i] >> 6 != 2)
            return 0;
        value = value << 6 | (text[i] & 0x3fu);
    }
    bool surrogate = value >= 0xd800 && value < 0xe000;
    return value < smallest[length] || value > 0x10ffff || surrogate ? 0 : length;
}

/* In quotes; octets that are no UTF-8 become U+FFFD. */
static void log_write_quoted(struct text *line, const char *message)
{
    const unsigned char *at = (const unsigned char *)message;
    text_add(line, "\"");
    while (*at) {
        int length = character_length(at);
        if (length == 0)
            text_add(line, "\\ufffd");
        else if (*at == '"' || *at == '\\')
            text_format(line, "\\%c", *at);
        else if (*at < 0x20 || *at == 0x7f)
            text_format(line, "\\u%04x", *at);
        else
            text_format(line, "%.*s", length, (const char *)at);
        at += length ? length : 1;
    }
    text_add(line, "\"");
}

static void log_write_json(struct text *line, enum log_level level,
                           const struct log_request *request, const char *message)
{
    text_add(line, "{\"time\":\"");
    log_write_time(line);
    text_format(line, "\",\"level\":\"%s\"", log_level_name(level));
    if (request) {
        char id[ID_SIZE];
        log_write_id(id, request->client);
        text_format(line, ",\"client\":\"%s\",\"sequence\":%llu", id,
                    (unsigned long long)request->sequence);
    }
    text_add(line, ",\"message\":");
    log_write_quoted(line, message);
    text_add(line, "}");
}

/* The levels of syslog(3). */
static int journal_level(enum log_level level)
{
    static const int levels[LEVEL_COUNT] = {3, 4, 6, 7};
    return levels[level];
}

static void log_write_plain(struct text *line, enum log_level level,
                            const struct log_request *request, char *message)
{
    if (used_format == LOG_JOURNAL) {
        text_format(line, "<%d>", journal_level(level));
    } else {
        log_write_time(line);
        text_format(line, " %-7s ", log_level_name(level));
    }
    if (request) {
        char id[ID_SIZE];
        log_write_id(id, request->client);
        text_format(line, "client %s request %llu: ", id, (unsigned long long)request->sequence);
    }
    /* no control character breaks the line */
    for (char *at = message; *at; at++) {
        if ((unsigned char)*at < 0x20)
            *at = ' ';
    }
    text_add(line, message);
}

static void log_put_line(enum log_level level, const struct log_request *request, char *message)
{
    char line[LINE_SIZE];
    struct text text = text_begin(line, sizeof line - 1);
    if (used_format == LOG_JSON)
        log_write_json(&text, level, request, message);
    else
        log_write_plain(&text, level, request, message);
    *text.at++ = '\n';
    /* one write a line, so that lines of several threads do not mix */
    ssize_t written = write(STDERR_FILENO, line, (size_t)(text.at - line));
    (void)written;
}

/* The debug level has no limit. */
static bool log_admits(enum log_level level, const char *format, const char *message)
{
    if (!rate_is_limited || level == LEVEL_DEBUG)
        return true;
    uint64_t kind = log_rate_kind(format, message);
    pthread_mutex_lock(&rate_lock);
    bool admitted = log_rate_admits(&rate, kind, level, message, clock_now());
    pthread_mutex_unlock(&rate_lock);
    return admitted;
}

static void log_write_line(enum log_level level, const struct log_request *request,
                           const char *format, va_list arguments)
{
    char message[MESSAGE_SIZE];
    if (vsnprintf(message, sizeof message, format, arguments) < 0)
        message[0] = '\0';
    if (log_admits(level, format, message))
        log_put_line(level, request, message);
}

void log_sum_up(bool all)
{
    enum log_level level;
    char message[MESSAGE_SIZE];
    bool found = rate_is_limited;
    while (found) {
        pthread_mutex_lock(&rate_lock);
        found = log_rate_sum(&rate, clock_now(), all, &level, message, sizeof message);
        pthread_mutex_unlock(&rate_lock);
        if (found)
            log_put_line(level, NULL, message);
    }
}

void log_line(enum log_level level, const char *format, ...)
{
    va_list arguments;
    if (!log_shows(level))
        return;
    va_start(arguments, format);
    log_write_line(level, NULL, format, arguments);
    va_end(arguments);
}

void log_about(enum log_level level, const struct log_request *request, const char *format, ...)
{
    va_list arguments;
    if (!log_shows(level))
        return;
    va_start(arguments, format);
    log_write_line(level, request, format, arguments);
    va_end(arguments);
}

/* Takes the first line; below it, security plugins add traces of libraries. */
static void log_dds_line(void *context, const dds_log_data_t *data)
{
    (void)context;
    bool is_error = data->priority & (DDS_LC_FATAL | DDS_LC_ERROR);
    log_line(is_error ? LEVEL_ERROR : LEVEL_WARNING, "DDS: %.*s", (int)strcspn(data->message, "\n"),
             data->message);
}

void log_take_dds(void)
{
    dds_set_log_sink(log_dds_line, NULL);
}
