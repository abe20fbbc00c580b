/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/key.h"

#include <stdio.h>

#include "model/body_kind.h"

/* A text that grows and is cut where it must. */
struct growing {
    char *text;
    size_t size, length;
};

static void key_grow(struct growing *growing, const char *before, const char *word)
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
        key_grow(growing, before, key->words[i]);
        before = ", ";
    }
}

/* How two ends that differ are written: the last word is that of a held end. */
static void grow_pair(struct growing *growing, const struct key *key)
{
    const char *loose = key->words[0], *held = key->words[key->word_count - 1];
    key_grow(growing, ", or two of them, at -x and at +x: [", held);
    key_grow(growing, ", ", loose);
    key_grow(growing, "], also written ", held);
    key_grow(growing, "-", loose);
    key_grow(growing, " or cantilever", "");
}

static void grow_keys(struct growing *growing, const struct key_table *table)
{
    const char *before = "";
    const struct key *key;
    for (size_t i = 0; (key = key_at(table, i)); i++) {
        key_grow(growing, before, key->name);
        before = ", ";
    }
}

static void grow_kinds(struct growing *growing)
{
    const char *before = "one of ";
    const struct body_kind *kind;
    for (size_t i = 0; (kind = body_kind_at(i)); i++) {
        key_grow(growing, before, kind->name);
        before = ", ";
    }
}

const struct key *key_at(const struct key_table *table, size_t number)
{
    size_t before = table->before ? table->before->count : 0;
    if (number < before)
        return &table->before->keys[number];
    return number - before < table->count ? &table->keys[number - before] : NULL;
}

struct key_text key_list(const struct key_table *table)
{
    struct key_text list = {{0}};
    struct growing growing = {list.text, sizeof list.text, 0};
    grow_keys(&growing, table);
    return list;
}

/* As it reads after "must be", by its type. */
static void grow_allowed(struct growing *growing, const struct key *key)
{
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_TWICE:
    case KEY_WHOLE:
    case KEY_YIELD:
        key_grow(growing, key->type == KEY_YIELD ? "none or " : "", key->limit->text);
        break;
    case KEY_NUMBERS:
        key_grow(growing, "a list of three, each ", key->limit->text);
        break;
    case KEY_FLAG:
        key_grow(growing, "", "true or false");
        break;
    case KEY_WORD:
        key_grow(growing, "one of ", "");
        grow_words(growing, key);
        break;
    case KEY_ENDS:
        key_grow(growing, "one of ", "");
        grow_words(growing, key);
        grow_pair(growing, key);
        break;
    case KEY_SHEAR:
        grow_words(growing, key);
        key_grow(growing, " or ", key->limit->text);
        break;
    case KEY_DAMPING:
        key_grow(
            growing, key->limit->text,
            ", or a list of such, of the modes from the lowest up, the last one of all others");
        break;
    case KEY_KIND:
        grow_kinds(growing);
        break;
    case KEY_NAME:
        key_grow(growing, "", "a name of materials");
        break;
    case KEY_SECTION:
        key_grow(growing, "a mapping of ", "");
        grow_keys(growing, key->nested);
        break;
    case KEY_TEXT:
        key_grow(growing, "", "a name that is not empty");
        break;
    case KEY_LIST:
        key_grow(growing, "", "a list");
        break;
    case KEY_CALLER:
        key_grow(growing, "", "a mapping of ids");
        break;
    }
}

struct key_text key_allowed(const struct key *key)
{
    struct key_text allowed = {{0}};
    struct growing growing = {allowed.text, sizeof allowed.text, 0};
    if (key->allowed)
        key_grow(&growing, "", key->allowed);
    else
        grow_allowed(&growing, key);
    return allowed;
}
