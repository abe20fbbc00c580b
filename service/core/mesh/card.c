/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/card.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/inp_keywords.h"

enum { CARD_NUMBER_SIZE = 128 };

static char *card_trim(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        text[--length] = '\0';
    return text;
}

/* Removes white space outside quotes, then the quotes. */
void card_name(char *text)
{
    bool quoted = false;
    char *to = text;
    for (const char *from = text; *from; from++) {
        if (*from == '"')
            quoted = !quoted;
        else if (quoted || !isspace((unsigned char)*from))
            *to++ = *from;
    }
    *to = '\0';
}

static void card_capitals(char *text)
{
    card_name(text);
    for (; *text; text++)
        *text = (char)toupper((unsigned char)*text);
}

/* the next line that is neither empty nor a comment */
static bool text_line(struct scan *scan, char *line, size_t size)
{
    while (scan_line(scan, line, size)) {
        char *text = card_trim(line);
        memmove(line, text, strlen(text) + 1);
        if (*line && strncmp(line, "**", 2) != 0)
            return true;
    }
    return false;
}

/* The first field of a line in capitals, up to a comma. */
static void first_word(const char *line, char word[CARD_LINE_SIZE])
{
    snprintf(word, CARD_LINE_SIZE, "%.*s", (int)strcspn(line, ","), line);
    card_capitals(word);
}

/* Whether a line goes on with the parameters of the keyword line before it, which ends with a
 * comma: such a comma may stand before lines of data too. */
static bool goes_on(const char *keyword, const char *line)
{
    char name[CARD_LINE_SIZE], word[CARD_LINE_SIZE];
    if (!isalpha((unsigned char)*line))
        return false;
    first_word(keyword + 1, name);
    first_word(line, word);
    return strchr(word, '=') || keyword_parameter(name, word) == PARAMETER_FLAG;
}

bool card_line(struct scan *scan, char line[CARD_LINE_SIZE], enum percuss_status *status)
{
    size_t filled = 0;
    struct scan before = *scan;
    *status = PERCUSS_OK;
    while (text_line(scan, line + filled, CARD_LINE_SIZE - filled)) {
        char *next = line + filled;
        if (filled > 0 && (*next == '*' || !goes_on(line, next))) {
            *next = '\0';
            *scan = before;
            return true;
        }
        filled += strlen(next);
        if (filled >= CARD_LINE_SIZE - 2) {
            *status = scan_refuse(scan, "a line of more than %d letters: must be shorter",
                                  CARD_LINE_SIZE - 2);
            return false;
        }
        if (line[0] != '*' || line[filled - 1] != ',')
            return true;
        before = *scan;
    }
    line[filled] = '\0';
    return filled > 0;
}

/* The name of a file keeps its blanks. */
static void unquote_path(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (*from != '"')
            *to++ = *from;
    *to = '\0';
}

bool card_parse(char *line, struct card *card)
{
    char *cursor = line + 1, *name = card_field(&cursor), *field;
    memset(card, 0, sizeof *card);
    snprintf(card->name, sizeof card->name, "%s", name ? name : "");
    card_capitals(card->name);
    while ((field = card_field(&cursor))) {
        if (*field == '\0')
            continue;
        if (card->parameter_count == CARD_MOST_PARAMETERS)
            return false;
        struct card_parameter *parameter = &card->parameters[card->parameter_count++];
        char *equals = strchr(field, '=');
        if (equals)
            *equals = '\0';
        snprintf(parameter->key, sizeof parameter->key, "%s", field);
        card_capitals(parameter->key);
        snprintf(parameter->value, sizeof parameter->value, "%s",
                 equals ? card_trim(equals + 1) : "");
        if (strcmp(parameter->key, "INPUT") == 0)
            unquote_path(parameter->value);
        else
            card_name(parameter->value);
    }
    return true;
}

const char *card_value(const struct card *card, const char *key)
{
    for (int i = 0; i < card->parameter_count; i++)
        if (strcmp(card->parameters[i].key, key) == 0)
            return card->parameters[i].value;
    return NULL;
}

char *card_field(char **cursor)
{
    if (!*cursor)
        return NULL;
    char *field = *cursor, *comma = field;
    bool quoted = false;
    for (; *comma && (quoted || *comma != ','); comma++)
        quoted ^= *comma == '"';
    *cursor = *comma ? comma + 1 : NULL;
    *comma = '\0';
    field = card_trim(field);
    /* a comma at the end of a line begins no field */
    return *field == '\0' && !*cursor ? NULL : field;
}

bool card_label(const struct scan *scan, const char *subject, const char *field, size_t *value)
{
    char *end;
    unsigned long long number = field ? strtoull(field, &end, 10) : 0;
    if (field && isdigit((unsigned char)*field) && *end == '\0' && number > 0 &&
        number <= SCAN_MOST) {
        *value = number;
        return true;
    }
    scan_refuse(scan, "%s: %.40s: must be a whole number from 1 to %zu", subject,
                field ? field : "nothing", SCAN_MOST);
    return false;
}

/* Fortran's exponents are D as well. */
bool card_real(const struct scan *scan, const char *subject, const char *field, double *value)
{
    char copy[CARD_NUMBER_SIZE], *end = copy;
    *value = 0.0;
    size_t length = field ? strlen(field) : 0;
    bool plain = length > 0 && length < sizeof copy && strspn(field, "0123456789+-.eEdD") == length;
    if (plain) {
        for (size_t i = 0; i <= length; i++)
            copy[i] = (char)(field[i] == 'd' || field[i] == 'D' ? 'e' : field[i]);
        *value = strtod(copy, &end);
    }
    if (plain && end != copy && *end == '\0')
        return true;
    scan_refuse(scan, "%s: %.40s: must be a number", subject, field ? field : "nothing");
    return false;
}
