/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/card.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *card_trim(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        text[--length] = '\0';
    return text;
}

bool card_line(struct scan *scan, char line[CARD_LINE_SIZE], enum percuss_status *status)
{
    size_t filled = 0;
    *status = PERCUSS_OK;
    while (scan_line(scan, line + filled, CARD_LINE_SIZE - filled)) {
        char *text = card_trim(line + filled);
        memmove(line + filled, text, strlen(text) + 1);
        if (line[filled] == '\0' || strncmp(line + filled, "**", 2) == 0) {
            line[filled] = '\0';
            continue;
        }
        filled += strlen(line + filled);
        if (filled >= CARD_LINE_SIZE - 2) {
            *status = scan_refuse(scan, "a line of more than %d letters: must be shorter",
                                  CARD_LINE_SIZE - 2);
            return false;
        }
        if (line[0] != '*' || line[filled - 1] != ',')
            return true;
    }
    return filled > 0;
}

static void copy_capitals(char to[CARD_TEXT_SIZE], const char *from)
{
    size_t i = 0;
    for (; from[i] && i < CARD_TEXT_SIZE - 1; i++)
        to[i] = (char)toupper((unsigned char)from[i]);
    to[i] = '\0';
}

void card_parse(char *line, struct card *card)
{
    char *cursor = line + 1, *name = card_field(&cursor), *field;
    memset(card, 0, sizeof *card);
    copy_capitals(card->name, name ? name : "");
    while ((field = card_field(&cursor)) && card->parameter_count < CARD_MOST_PARAMETERS) {
        char *equals = strchr(field, '=');
        if (equals)
            *equals = '\0';
        int i = card->parameter_count++;
        copy_capitals(card->parameters[i].key, card_trim(field));
        snprintf(card->parameters[i].value, CARD_TEXT_SIZE, "%s",
                 equals ? card_trim(equals + 1) : "");
    }
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
    char *field = *cursor, *comma = strchr(field, ',');
    if (comma)
        *comma = '\0';
    *cursor = comma ? comma + 1 : NULL;
    field = card_trim(field);
    /* a comma at the end of a line begins no field */
    return *field == '\0' && !*cursor ? NULL : field;
}

bool card_label(const struct scan *scan, const char *subject, const char *field, size_t *value)
{
    char *end;
    errno = 0;
    unsigned long long number = field ? strtoull(field, &end, 10) : 0;
    if (field && isdigit((unsigned char)*field) && *end == '\0' && !errno && number > 0) {
        *value = number;
        return true;
    }
    scan_refuse(scan, "%s: %.40s: must be a whole number > 0", subject, field ? field : "nothing");
    return false;
}

bool card_real(const struct scan *scan, const char *subject, const char *field, double *value)
{
    char *end;
    *value = field ? strtod(field, &end) : 0.0;
    if (field && end != field && *end == '\0')
        return true;
    scan_refuse(scan, "%s: %.40s: must be a number", subject, field ? field : "nothing");
    return false;
}
