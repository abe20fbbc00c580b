/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "text.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Larger files are a mistake. */
static const size_t MOST_BYTES = (size_t)1 << 30;

const char *text_name(const char *file)
{
    return strcmp(file, "-") != 0 ? file : "standard input";
}

/* All that there is to read. */
static uint8_t *read_all(FILE *in, size_t *size)
{
    size_t room = 1 << 16;
    uint8_t *bytes = malloc(room);
    *size = 0;
    while (bytes && !ferror(in)) {
        *size += fread(bytes + *size, 1, room - *size, in);
        if (*size < room || room > MOST_BYTES)
            break;
        uint8_t *more = realloc(bytes, 2 * room);
        if (!more)
            free(bytes);
        bytes = more;
        room *= 2;
    }
    if (bytes && (ferror(in) || *size > MOST_BYTES)) {
        free(bytes);
        bytes = NULL;
    }
    return bytes;
}

static uint8_t *load(const char *file, size_t *size, struct measured_fault *fault)
{
    bool standard_input = !strcmp(file, "-");
    errno = 0;
    FILE *in = standard_input ? stdin : fopen(file, "rb");
    uint8_t *bytes = in ? read_all(in, size) : NULL;
    if (!bytes)
        measured_fail(fault, "%s: %s", text_name(file), errno ? strerror(errno) : "cannot be read");
    if (in && !standard_input)
        fclose(in);
    return bytes;
}

bool text_is_file(const char *file, struct measured_fault *fault)
{
    errno = 0;
    FILE *in = fopen(file, "rb");
    long size = -1;
    if (in && fseek(in, 0, SEEK_END) == 0)
        size = ftell(in);
    if (!in)
        measured_fail(fault, "%s: %s", file, strerror(errno));
    else if (size <= 0)
        measured_fail(fault, "%s: must be a file with something in it", file);
    if (in)
        fclose(in);
    return size > 0;
}

/* Appends a character; up to four bytes. */
static uint8_t *put(uint8_t *to, uint32_t c)
{
    if (c < 0x80) {
        *to++ = (uint8_t)c;
    } else if (c < 0x800) {
        *to++ = (uint8_t)(0xC0 | c >> 6);
        *to++ = (uint8_t)(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        *to++ = (uint8_t)(0xE0 | c >> 12);
        *to++ = (uint8_t)(0x80 | (c >> 6 & 0x3F));
        *to++ = (uint8_t)(0x80 | (c & 0x3F));
    } else {
        *to++ = (uint8_t)(0xF0 | c >> 18);
        *to++ = (uint8_t)(0x80 | (c >> 12 & 0x3F));
        *to++ = (uint8_t)(0x80 | (c >> 6 & 0x3F));
        *to++ = (uint8_t)(0x80 | (c & 0x3F));
    }
    return to;
}

/* Two bytes a character, or four for a pair of surrogates. Returns the text's end. */
static uint8_t *from_utf16(const uint8_t *from, size_t size, bool big_end, uint8_t *to)
{
    uint32_t high = 0;
    for (size_t i = 0; i + 1 < size; i += 2) {
        uint32_t c =
            big_end ? (uint32_t)from[i] << 8 | from[i + 1] : (uint32_t)from[i + 1] << 8 | from[i];
        bool low = c >= 0xDC00 && c < 0xE000;
        if (low && high)
            c = 0x10000 + ((high - 0xD800) << 10) + (c - 0xDC00);
        high = c >= 0xD800 && c < 0xDC00 ? c : 0;
        /* half a pair is no character */
        if (!high)
            to = put(to, c >= 0xD800 && c < 0xE000 ? 0xFFFD : c);
    }
    return to;
}

/* How many bytes the character has that begins here; 0: it is no UTF-8. */
static size_t character_size(const uint8_t *at, size_t left)
{
    size_t size = *at < 0x80                  ? 1
                  : *at >= 0xC2 && *at < 0xE0 ? 2
                  : *at >= 0xE0 && *at < 0xF0 ? 3
                  : *at >= 0xF0 && *at < 0xF5 ? 4
                                              : 0;
    if (size > left)
        return 0;
    for (size_t i = 1; i < size; i++)
        if ((at[i] & 0xC0) != 0x80)
            return 0;
    return size;
}

static bool is_utf8(const uint8_t *text, size_t size)
{
    size_t length = 1;
    for (size_t i = 0; i < size && length > 0; i += length)
        length = character_size(text + i, size - i);
    return length > 0;
}

/* Above 0x9F it is Unicode; no quantity or unit has one of those below. */
static uint8_t *from_windows(const uint8_t *from, size_t size, uint8_t *to)
{
    for (size_t i = 0; i < size; i++)
        to = put(to, from[i] >= 0x80 && from[i] < 0xA0 ? 0xFFFD : from[i]);
    return to;
}

/* In place. */
static void unify_line_ends(uint8_t *text)
{
    uint8_t *to = text;
    for (const uint8_t *from = text; *from; from++) {
        if (from[0] == '\r' && from[1] == '\n')
            continue;
        *to++ = *from == '\r' ? '\n' : *from;
    }
    *to = '\0';
}

/* As UTF-8, with a zero behind it; NULL: out of memory. */
static uint8_t *decode(const uint8_t *bytes, size_t size, size_t *length)
{
    static const uint8_t mark[] = {0xEF, 0xBB, 0xBF};
    uint8_t *text = malloc(3 * size + 1), *end;
    if (!text)
        return NULL;
    if (size >= 2 && bytes[0] == 0xFF && bytes[1] == 0xFE) {
        end = from_utf16(bytes + 2, size - 2, false, text);
    } else if (size >= 2 && bytes[0] == 0xFE && bytes[1] == 0xFF) {
        end = from_utf16(bytes + 2, size - 2, true, text);
    } else if (is_utf8(bytes, size)) {
        memcpy(text, bytes, size);
        end = text + size;
    } else {
        end = from_windows(bytes, size, text);
    }
    *length = (size_t)(end - text);
    /* a program that adds a mark may find one */
    size_t marks = 0;
    while (*length - marks >= sizeof mark && !memcmp(text + marks, mark, sizeof mark))
        marks += sizeof mark;
    *length -= marks;
    memmove(text, text + marks, *length);
    text[*length] = '\0';
    return text;
}

char *text_read(const char *file, struct measured_fault *fault)
{
    size_t size = 0, length = 0;
    uint8_t *bytes = load(file, &size, fault);
    uint8_t *text = bytes ? decode(bytes, size, &length) : NULL;
    if (bytes && !text)
        measured_fail(fault, "%s: out of memory", text_name(file));
    free(bytes);
    if (text && memchr(text, '\0', length)) {
        measured_fail(fault, "%s: a zero byte is in it: text is needed", text_name(file));
        free(text);
        text = NULL;
    }
    if (text)
        unify_line_ends(text);
    return (char *)text;
}
