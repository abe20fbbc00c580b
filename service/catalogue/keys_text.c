/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdio.h>
#include <string.h>

#include "catalogue/keys.h"

/* A text that grows and is cut where it must. */
struct growing {
    char *text;
    size_t size, length;
};

static void grow(struct growing *growing, const char *before, const char *word)
{
    size_t room = growing->size - growing->length;
    int written = snprintf(growing->text + growing->length, room, "%s%s", before, word);
    growing->length += (size_t)written < room ? (size_t)written : room - 1;
}

static void grow_words(struct growing *growing, const struct key *key)
{
    const char *before = "";
    for (size_t i = 0; i < key->word_count; i++) {
        if (!key->words[i])
            continue;
        grow(growing, before, key->words[i]);
        before = ", ";
    }
}

/* A key with several rows (one a shape) is named once. */
static void grow_keys(struct growing *growing, const struct key_table *table, unsigned shapes)
{
    const char *before = "";
    for (size_t i = 0; i < table->count; i++) {
        const struct key *key = &table->keys[i];
        if (!(key->shapes & shapes) || keys_find(table, key->name, shapes) != key)
            continue;
        grow(growing, before, key->name);
        before = ", ";
    }
}

struct key_text keys_list(const struct key_table *table, unsigned shapes)
{
    struct key_text list = {{0}};
    struct growing growing = {list.text, sizeof list.text, 0};
    grow_keys(&growing, table, shapes);
    return list;
}

struct key_text keys_allowed(const struct key *key)
{
    struct key_text allowed = {{0}};
    struct growing growing = {allowed.text, sizeof allowed.text, 0};
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_WHOLE:
        grow(&growing, "", key->limit->text);
        break;
    case KEY_NUMBERS:
        grow(&growing, "a list of three, each ", key->limit->text);
        break;
    case KEY_FLAG:
        grow(&growing, "", "true or false");
        break;
    case KEY_WORD:
        grow(&growing, "one of ", "");
        grow_words(&growing, key);
        break;
    case KEY_ENDS:
        grow(&growing, "one of ", "");
        grow_words(&growing, key);
        grow(&growing, "", ", or a list of two of them");
        break;
    case KEY_SHEAR:
        grow_words(&growing, key);
        grow(&growing, " or ", key->limit->text);
        break;
    case KEY_NAME:
        grow(&growing, "", "a name of materials");
        break;
    case KEY_SECTION:
        grow(&growing, "a mapping of ", "");
        grow_keys(&growing, key->nested, KEYS_ANY);
        break;
    case KEY_CALLER:
        grow(&growing, "", "a mapping of ids");
        break;
    }
    return allowed;
}
