/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/bdf_card.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/grow.h"

enum { NARROW = 8, WIDE = 16, NARROW_FIELDS = 8, WIDE_FIELDS = 4, MARK_COLUMN = 72 };

static enum percuss_status refuse_line(const struct bdf_lines *lines, const char *message,
                                       const char *word)
{
    struct scan at = lines->scan;
    at.line = lines->line;
    return scan_refuse(&at, message, word);
}

/* ---- lines ---- */

/* Copies a line without its comment and what is behind it; tabs go to columns of eight. False: it
 * does not fit. */
static bool expand(const char *from, char to[BDF_LINE_SIZE])
{
    size_t filled = 0;
    char quote = '\0';
    for (; *from && (quote || *from != '$'); from++) {
        if (quote ? *from == quote : *from == '\'' || *from == '"')
            quote = quote ? '\0' : *from;
        do {
            if (filled == BDF_LINE_SIZE - 1)
                return false;
            to[filled++] = *from == '\t' ? ' ' : *from;
        } while (*from == '\t' && filled % NARROW != 0);
    }
    while (filled > 0 && isspace((unsigned char)to[filled - 1]))
        filled--;
    to[filled] = '\0';
    return true;
}

/* Holds the next line that is neither empty nor a comment; false: there is none. */
static bool hold_line(struct bdf_lines *lines, enum percuss_status *status)
{
    char raw[BDF_LINE_SIZE];
    while (!lines->held && scan_line(&lines->scan, raw, sizeof raw)) {
        lines->line = lines->scan.line;
        bool whole = raw[0] == '$' || strlen(raw) < sizeof raw - 1;
        if (!expand(raw, lines->text) || !whole) {
            *status = refuse_line(lines, "%s: must be shorter", "a line of more than 500 letters");
            return false;
        }
        lines->held = lines->text[0] != '\0';
    }
    return lines->held;
}

/* The first word of a line, in capitals. */
static void first_word(const char *text, char word[BDF_FIELD_SIZE])
{
    size_t i = 0;
    while (*text == ' ')
        text++;
    for (; text[i] && text[i] != ' ' && text[i] != ',' && i < BDF_FIELD_SIZE - 1; i++)
        word[i] = (char)toupper((unsigned char)text[i]);
    word[i] = '\0';
}

/* Whether a line says BEGIN BULK (or BEGIN, which means the same). */
static bool begins_bulk(const char *text)
{
    char word[BDF_FIELD_SIZE];
    first_word(text, word);
    return strcmp(word, "BEGIN") == 0;
}

static bool ends_executive(const char *text)
{
    char word[BDF_FIELD_SIZE];
    first_word(text, word);
    return strcmp(word, "CEND") == 0;
}

enum percuss_status bdf_open(struct bdf_lines *lines, const char *path, enum bdf_start start,
                             struct fault *fault)
{
    memset(lines, 0, sizeof *lines);
    enum percuss_status status = scan_open(path, &lines->scan, fault);
    if (status != PERCUSS_OK)
        return status;
    struct scan front = lines->scan;
    lines->alone = start == BDF_WHOLE;
    while (lines->alone && hold_line(lines, &status)) {
        lines->alone = !begins_bulk(lines->text) && !ends_executive(lines->text);
        lines->held = false;
    }
    lines->bulk = start == BDF_BULK || lines->alone;
    if (status != PERCUSS_OK) {
        scan_close(&lines->scan);
        return status;
    }
    lines->scan = front;
    return PERCUSS_OK;
}

/* ---- fields ---- */

/* Adds a field without the white space around it; false with a message. */
static bool add_field(struct bdf_lines *lines, struct bdf_card *card, const char *text,
                      size_t length, enum percuss_status *status)
{
    while (length > 0 && isspace((unsigned char)*text)) {
        text++;
        length--;
    }
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        length--;
    if (length >= BDF_FIELD_SIZE) {
        *status = refuse_line(lines, "%s: must be shorter", "a field of more than 23 letters");
        return false;
    }
    if (!GROW(card->fields, card->count, card->room)) {
        *status =
            fault_set(lines->scan.fault, PERCUSS_INTERNAL, "%s: out of memory", lines->scan.file);
        return false;
    }
    char *field = card->fields[card->count++];
    memcpy(field, text, length);
    field[length] = '\0';
    return true;
}

/* What a line has besides its fields: its name or mark in front, its mark behind. */
struct ends {
    char front[BDF_FIELD_SIZE], behind[BDF_FIELD_SIZE];
    bool wide;
};

static void trimmed(const char *text, size_t length, char to[BDF_FIELD_SIZE])
{
    while (length > 0 && *text == ' ') {
        text++;
        length--;
    }
    while (length > 0 && text[length - 1] == ' ')
        length--;
    snprintf(to, BDF_FIELD_SIZE, "%.*s", (int)length, text);
}

static void find_front(const char *text, struct ends *ends)
{
    const char *comma = strchr(text, ',');
    size_t length = strlen(text);
    if (comma)
        length = (size_t)(comma - text);
    else if (length > NARROW)
        length = NARROW;
    trimmed(text, length, ends->front);
    ends->wide = strchr(ends->front, '*') != NULL;
}

/* A line continues the one above if its first field is empty or begins with + or *. */
static bool continues(const char *text)
{
    struct ends ends;
    find_front(text, &ends);
    return ends.front[0] == '\0' || ends.front[0] == '+' || ends.front[0] == '*';
}

/* fields of 8 or 16 columns; what stands beyond column 80 is none of Nastran's */
static bool split_columns(struct bdf_lines *lines, struct bdf_card *card, struct ends *ends,
                          enum percuss_status *status)
{
    size_t length = strlen(lines->text), width = ends->wide ? WIDE : NARROW;
    for (size_t at = NARROW; at < MARK_COLUMN; at += width) {
        size_t left = at < length ? length - at : 0;
        if (!add_field(lines, card, lines->text + (left ? at : length), left < width ? left : width,
                       status))
            return false;
    }
    if (length > MARK_COLUMN)
        trimmed(lines->text + MARK_COLUMN,
                length - MARK_COLUMN < NARROW ? length - MARK_COLUMN : NARROW, ends->behind);
    return true;
}

/* fields between commas, as many as columns have; a mark may follow them */
static bool split_commas(struct bdf_lines *lines, struct bdf_card *card, struct ends *ends,
                         enum percuss_status *status)
{
    const char *at = strchr(lines->text, ',');
    size_t most = ends->wide ? WIDE_FIELDS : NARROW_FIELDS;
    for (size_t i = 0; i < most; i++) {
        size_t length = at ? strcspn(at + 1, ",") : 0;
        if (!add_field(lines, card, at ? at + 1 : "", length, status))
            return false;
        at = at ? strchr(at + 1, ',') : NULL;
    }
    if (!at)
        return true;
    trimmed(at + 1, strlen(at + 1), ends->behind);
    if (strchr(ends->behind, ',') || (ends->behind[0] && !strchr("+*", ends->behind[0]))) {
        *status = refuse_line(lines,
                              "%s: a line has 8 fields behind its name (4 of 16 columns), then a "
                              "mark that begins with + or *; others go to the next line",
                              ends->behind);
        return false;
    }
    return true;
}

/* the mark without + and *, "" if it says no more */
static const char *mark_text(const char *mark)
{
    while (*mark == '+' || *mark == '*' || *mark == ' ')
        mark++;
    return mark;
}

/* adds the held line to the card */
static bool take_line(struct bdf_lines *lines, struct bdf_card *card, struct ends *above,
                      enum percuss_status *status)
{
    struct ends ends = {"", "", false};
    find_front(lines->text, &ends);
    /* a mark must be that of the line above, as continuations are taken in the order of the file */
    const char *front = mark_text(ends.front), *behind = mark_text(above->behind);
    if (card->count > 0 && *front && *behind && strcasecmp(front, behind) != 0) {
        *status = refuse_line(
            lines, "the continuation %s must follow the line that ends with this mark", ends.front);
        return false;
    }
    bool whole = strchr(lines->text, ',') ? split_commas(lines, card, &ends, status)
                                          : split_columns(lines, card, &ends, status);
    *above = ends;
    lines->held = false;
    return whole;
}

static void begin_card(struct bdf_lines *lines, struct bdf_card *card)
{
    struct ends ends;
    find_front(lines->text, &ends);
    card->scan = &lines->scan;
    card->line = lines->line;
    card->count = 0;
    first_word(ends.front, card->name);
    char *star = strchr(card->name, '*');
    if (star)
        *star = '\0';
}

/* whether the held line is a card of bulk data; skips what is not */
static bool hold_card(struct bdf_lines *lines, enum percuss_status *status)
{
    char word[BDF_FIELD_SIZE];
    while (hold_line(lines, status)) {
        first_word(lines->text, word);
        if (lines->bulk || strcmp(word, "INCLUDE") == 0 || strcmp(word, "PARAM") == 0)
            return true;
        lines->bulk = begins_bulk(lines->text);
        lines->held = false;
    }
    return false;
}

bool bdf_next(struct bdf_lines *lines, struct bdf_card *card, enum percuss_status *status)
{
    struct ends above = {"", "", false};
    *status = PERCUSS_OK;
    if (!hold_card(lines, status))
        return false;
    first_word(lines->text, card->name);
    card->scan = &lines->scan;
    card->line = lines->line;
    card->count = 0;
    /* its path may have any letters and lines */
    if (strcmp(card->name, "INCLUDE") == 0)
        return true;
    if (strcmp(card->name, "ENDDATA") == 0) {
        lines->scan.at = lines->scan.size;
        return false;
    }
    if (continues(lines->text)) {
        *status =
            refuse_line(lines, "%s: must follow the line that it continues", "a continuation");
        return false;
    }
    begin_card(lines, card);
    do {
        if (!take_line(lines, card, &above, status))
            return false;
        /* lines of control may be indented, and continue nothing */
    } while (lines->bulk && hold_line(lines, status) && continues(lines->text));
    return *status == PERCUSS_OK;
}

enum percuss_status bdf_include(struct bdf_lines *lines, char path[BDF_PATH_SIZE])
{
    char name[BDF_PATH_SIZE] = "";
    enum percuss_status status = PERCUSS_OK;
    const char *text = lines->text;
    size_t filled = 0;
    while (*text == ' ')
        text++;
    text += strlen("INCLUDE");
    while (*text == ' ')
        text++;
    /* between quotes it goes on over lines */
    char quote = *text == '\'' || *text == '"' ? *text++ : '\0';
    for (;;) {
        for (; *text && *text != quote && filled < sizeof name - 1; text++)
            name[filled++] = *text;
        name[filled] = '\0';
        if (!quote || *text == quote)
            break;
        lines->held = false;
        if (filled == sizeof name - 1 || !hold_line(lines, &status))
            return refuse_line(lines, "%s: its path must end with the quote it begins with",
                               "INCLUDE");
        for (text = lines->text; *text == ' '; text++)
            ;
    }
    lines->held = false;
    if (!filled)
        return refuse_line(lines, "%s: must name a file", "INCLUDE");
    const char *slash = strrchr(lines->scan.file, '/');
    int folder = name[0] != '/' && slash ? (int)(slash + 1 - lines->scan.file) : 0;
    if (snprintf(path, BDF_PATH_SIZE, "%.*s%s", folder, lines->scan.file, name) >= BDF_PATH_SIZE)
        return refuse_line(lines, "%s: its path must be shorter", "INCLUDE");
    return PERCUSS_OK;
}

void bdf_card_free(struct bdf_card *card)
{
    free(card->fields);
    memset(card, 0, sizeof *card);
}

/* ---- values ---- */

enum percuss_status bdf_refuse(const struct bdf_card *card, const char *format, ...)
{
    char message[sizeof card->scan->fault->text];
    struct scan at = *card->scan;
    at.line = card->line;
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    return scan_refuse(&at, "%s: %s", card->name, message);
}

const char *bdf_field(const struct bdf_card *card, size_t field)
{
    return field - 2 < card->count ? card->fields[field - 2] : "";
}

bool bdf_is_blank(const struct bdf_card *card, size_t field)
{
    return bdf_field(card, field)[0] == '\0';
}

bool bdf_size(const struct bdf_card *card, size_t field, size_t *value)
{
    const char *text = bdf_field(card, field);
    char *end;
    unsigned long long number = strtoull(text, &end, 10);
    if (*text == '\0')
        return true;
    if (isdigit((unsigned char)*text) && *end == '\0' && number <= SCAN_MOST) {
        *value = number;
        return true;
    }
    bdf_refuse(card, "field %zu: %s: must be a whole number from 0 to %zu", field, text, SCAN_MOST);
    return false;
}

bool bdf_label(const struct bdf_card *card, size_t field, size_t *value)
{
    *value = 0;
    if (!bdf_size(card, field, value))
        return false;
    if (*value > 0)
        return true;
    bdf_refuse(card, "field %zu: %s: must be a whole number > 0", field,
               bdf_is_blank(card, field) ? "nothing" : bdf_field(card, field));
    return false;
}

bool bdf_real(const struct bdf_card *card, size_t field, double *value)
{
    const char *text = bdf_field(card, field);
    char copy[BDF_FIELD_SIZE + 1], *end = copy;
    size_t filled = 0;
    bool exponent = false;
    if (*text == '\0')
        return true;
    /* D and a sign alone begin an exponent, too */
    for (const char *c = text; *c && filled < sizeof copy - 2; c++) {
        bool sign = *c == '+' || *c == '-', letter = strchr("eEdD", *c) != NULL;
        if (sign && c > text && !exponent && !strchr("eEdD", c[-1])) {
            copy[filled++] = 'E';
            exponent = true;
        }
        exponent = exponent || letter;
        copy[filled++] = letter ? 'E' : *c;
    }
    copy[filled] = '\0';
    if (strspn(copy, "0123456789+-.E") == filled)
        *value = strtod(copy, &end);
    if (end > copy && *end == '\0')
        return true;
    bdf_refuse(card, "field %zu: %s: must be a number", field, text);
    return false;
}
