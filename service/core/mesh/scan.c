/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/scan.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_SIZE = 32 };
static const char BYTE_ORDER_MARK[] = "\xEF\xBB\xBF";

/* reads the rest of a stream into growing memory */
static enum percuss_status read_stream(FILE *stream, const char *path, struct scan *scan,
                                       struct fault *fault)
{
    size_t room = 1 << 16;
    scan->text = malloc(room);
    while (scan->text) {
        scan->size += fread(scan->text + scan->size, 1, room - 1 - scan->size, stream);
        if (scan->size < room - 1)
            break;
        room *= 2;
        char *larger = realloc(scan->text, room);
        if (!larger)
            free(scan->text);
        scan->text = larger;
    }
    if (!scan->text)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", path);
    if (ferror(stream))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path, strerror(errno));
    scan->text[scan->size] = '\0';
    /* editors on Windows write this mark first */
    scan->at = strncmp(scan->text, BYTE_ORDER_MARK, sizeof BYTE_ORDER_MARK - 1) == 0
                   ? sizeof BYTE_ORDER_MARK - 1
                   : 0;
    return PERCUSS_OK;
}

enum percuss_status scan_open(const char *path, struct scan *scan, struct fault *fault)
{
    *scan = (struct scan){.file = path, .line = 1, .fault = fault};
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", path, strerror(errno));
    enum percuss_status status = read_stream(stream, path, scan, fault);
    fclose(stream);
    if (status != PERCUSS_OK)
        scan_close(scan);
    return status;
}

void scan_close(struct scan *scan)
{
    free(scan->text);
    scan->text = NULL;
    scan->size = scan->at = 0;
}

enum percuss_status scan_refuse(const struct scan *scan, const char *format, ...)
{
    char message[sizeof scan->fault->text];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (scan->binary)
        return fault_set(scan->fault, PERCUSS_BAD_REQUEST, "%s: byte %zu: %s", scan->file, scan->at,
                         message);
    return fault_set(scan->fault, PERCUSS_BAD_REQUEST, "%s:%zu: %s", scan->file, scan->line,
                     message);
}

bool scan_line(struct scan *scan, char *line, size_t size)
{
    if (scan->at >= scan->size)
        return false;
    scan->line += scan->ended;
    const char *from = scan->text + scan->at;
    const char *end = memchr(from, '\n', scan->size - scan->at);
    size_t length = end ? (size_t)(end - from) : scan->size - scan->at;
    size_t shown = length < size - 1 ? length : size - 1;
    memcpy(line, from, shown);
    line[shown] = '\0';
    if (shown > 0 && line[shown - 1] == '\r')
        line[shown - 1] = '\0';
    scan->at += length + (end != NULL);
    scan->ended = end != NULL;
    return true;
}

static void skip_space(struct scan *scan)
{
    scan->line += scan->ended;
    scan->ended = 0;
    for (; scan->at < scan->size && isspace((unsigned char)scan->text[scan->at]); scan->at++)
        scan->line += scan->text[scan->at] == '\n';
}

/* takes the bytes of a number; false with a message: the file ends before */
static bool take_bytes(struct scan *scan, const char *subject, void *value, size_t size)
{
    if (scan->size - scan->at < size) {
        scan_refuse(scan, "%s: the file ends here: it must be whole", subject);
        return false;
    }
    memcpy(value, scan->text + scan->at, size);
    scan->at += size;
    return true;
}

/* refuses a word that is no number, or the end of the file */
static bool refuse_word(const struct scan *scan, const char *subject, const char *allowed)
{
    char word[WORD_SIZE];
    size_t length = 0;
    for (size_t i = scan->at; i < scan->size && length < sizeof word - 1; i++) {
        unsigned char c = (unsigned char)scan->text[i];
        if (isspace(c))
            break;
        word[length++] = c < 0x20 || c >= 0x7F ? '?' : (char)c;
    }
    word[length] = '\0';
    if (length == 0)
        scan_refuse(scan, "%s: the file ends here: it must be whole", subject);
    else
        scan_refuse(scan, "%s: %s: must be %s", subject, word, allowed);
    return false;
}

/* skips a number that strto... has read up to `end`; white space must follow */
static bool scan_pass(struct scan *scan, const char *end)
{
    size_t at = (size_t)(end - scan->text);
    if (at == scan->at || (at < scan->size && !isspace((unsigned char)*end)))
        return false;
    scan->at = at;
    return true;
}

bool scan_integer(struct scan *scan, const char *subject, int *value)
{
    if (scan->binary)
        return take_bytes(scan, subject, value, sizeof *value);
    skip_space(scan);
    char *end;
    errno = 0;
    long number = strtol(scan->text + scan->at, &end, 10);
    if (errno || number < INT_MIN || number > INT_MAX || !scan_pass(scan, end))
        return refuse_word(scan, subject, "a whole number");
    *value = (int)number;
    return true;
}

bool scan_size(struct scan *scan, const char *subject, size_t *value)
{
    if (scan->binary) {
        uint64_t number;
        if (!take_bytes(scan, subject, &number, sizeof number))
            return false;
        *value = number;
        if (number <= SCAN_MOST)
            return true;
        scan_refuse(scan, "%s: %zu: must be from 0 to %zu", subject, *value, SCAN_MOST);
        return false;
    }
    skip_space(scan);
    char *end;
    unsigned long long number = strtoull(scan->text + scan->at, &end, 10);
    if (number > SCAN_MOST || !isdigit((unsigned char)scan->text[scan->at]) ||
        !scan_pass(scan, end))
        return refuse_word(scan, subject, "a whole number from 0 to 9223372036854775807");
    *value = number;
    return true;
}

bool scan_real(struct scan *scan, const char *subject, double *value)
{
    if (scan->binary)
        return take_bytes(scan, subject, value, sizeof *value);
    skip_space(scan);
    char *end;
    *value = strtod(scan->text + scan->at, &end);
    return scan_pass(scan, end) || refuse_word(scan, subject, "a number");
}

bool scan_count(struct scan *scan, const char *subject, size_t *value)
{
    if (!scan_size(scan, subject, value))
        return false;
    if (*value <= scan->size - scan->at)
        return true;
    scan_refuse(scan, "%s: %zu: the file is too short for so many: it must be whole", subject,
                *value);
    return false;
}
