/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tally.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 512, PLACE = 128 };

struct tally_entry {
    char kind[TEXT]; /* the text without its numbers */
    char text[TEXT], place[PLACE];
    size_t count, last; /* number of the reply that was counted last */
};

/* The number that a word is, as in "(5092 m/s)" and "12:" but not in "al-rod-1" and "contacts[0]":
 * its length, 0 if it is none. */
static size_t number_at(const char *word)
{
    char *end;
    strtod(word, &end);
    size_t length = (size_t)(end - word);
    bool is_word = !*end || isspace((unsigned char)*end) || strchr("),:;%", *end);
    return is_word ? length : 0;
}

static void find_kind(const char *text, char kind[TEXT])
{
    size_t used = 0;
    bool begins = true; /* a word */
    while (*text && used + 1 < TEXT) {
        size_t length = begins && !isspace((unsigned char)*text) ? number_at(text) : 0;
        begins = isspace((unsigned char)*text) || *text == '(';
        kind[used++] = length ? '#' : *text;
        text += length ? length : 1;
    }
    kind[used] = '\0';
}

static bool add(struct tally *tally, const char *text, const char *place)
{
    char kind[TEXT];
    size_t i = 0;
    /* warnings that differ in their numbers alone are of one kind */
    find_kind(text, kind);
    while (i < tally->count && strcmp(tally->entries[i].kind, kind) != 0)
        i++;
    if (i == tally->room) {
        size_t room = tally->room ? 2 * tally->room : 8;
        struct tally_entry *entries = realloc(tally->entries, room * sizeof *entries);
        if (!entries)
            return false;
        tally->entries = entries;
        tally->room = room;
    }
    /* of a kind the first one is kept */
    struct tally_entry *entry = &tally->entries[i];
    if (i == tally->count) {
        *entry = (struct tally_entry){0};
        strcpy(entry->kind, kind);
        snprintf(entry->text, sizeof entry->text, "%s", text);
        snprintf(entry->place, sizeof entry->place, "%s", place);
        tally->count++;
    }
    /* counted once for each reply */
    entry->count += entry->last != tally->asked;
    entry->last = tally->asked;
    return true;
}

/* The statuses of an answer that is not all that was asked for. */
static bool is_warning(enum percuss_status status)
{
    return status == PERCUSS_TRUNCATED || status == PERCUSS_NOT_APPROACHING;
}

bool tally_take(struct tally *tally, const struct percuss_reply *reply, const char *place)
{
    char text[TEXT];
    tally->asked++;
    snprintf(text, sizeof text, "%s: %.450s", percuss_status_name(reply->status), reply->message);
    bool good = !is_warning(reply->status) || add(tally, text, place);
    for (size_t i = 0; good && i < reply->warning_count; i++)
        good = add(tally, reply->warnings[i], place);
    return good;
}

void tally_clear(struct tally *tally)
{
    free(tally->entries);
    *tally = (struct tally){.unit = tally->unit};
}

void tally_line(const struct tally *tally, size_t i, char line[TALLY_LINE])
{
    const struct tally_entry *entry = &tally->entries[i];
    snprintf(line, TALLY_LINE, "%s: %zu of %zu, first %s: %s", tally->unit, entry->count,
             tally->asked, entry->place, entry->text);
}
