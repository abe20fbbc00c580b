/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/inbox.h"

#include <stdlib.h>
#include <sys/queue.h>

#include "exchange/key_map.h"

enum { EXPECTED_WRITERS = 64 };

struct letter {
    STAILQ_ENTRY(letter) next;
    void *sample;
};

/* The samples of one writer, at least one. */
struct pile {
    struct key_node node; /* key: the writer */
    TAILQ_ENTRY(pile) turn;
    STAILQ_HEAD(letters, letter) letters;
    size_t count;
};

struct inbox {
    size_t most;
    void (*release)(void *sample);
    struct key_map piles;
    TAILQ_HEAD(pile_turns, pile) turns;
};

struct inbox *inbox_create(size_t most, void (*release)(void *sample))
{
    struct inbox *inbox = calloc(1, sizeof *inbox);
    if (!inbox)
        return NULL;
    if (!key_map_create(&inbox->piles, EXPECTED_WRITERS)) {
        free(inbox);
        return NULL;
    }
    inbox->most = most;
    inbox->release = release;
    TAILQ_INIT(&inbox->turns);
    return inbox;
}

void inbox_free(struct inbox *inbox)
{
    if (!inbox)
        return;
    uint64_t writer;
    for (void *sample; (sample = inbox_take(inbox, &writer));)
        inbox->release(sample);
    key_map_release(&inbox->piles);
    free(inbox);
}

/* NULL: out of memory. */
static struct pile *pile_open(struct inbox *inbox, uint64_t writer)
{
    struct digest key = {writer, 0};
    struct key_node *node = key_map_find(&inbox->piles, key);
    if (node)
        return KEY_MAP_OWNER(node, struct pile, node);
    struct pile *pile = calloc(1, sizeof *pile);
    if (!pile)
        return NULL;
    pile->node.key = key;
    STAILQ_INIT(&pile->letters);
    key_map_insert(&inbox->piles, &pile->node);
    TAILQ_INSERT_TAIL(&inbox->turns, pile, turn);
    return pile;
}

static void pile_drop_if_empty(struct inbox *inbox, struct pile *pile)
{
    if (pile->count > 0)
        return;
    key_map_remove(&inbox->piles, &pile->node);
    TAILQ_REMOVE(&inbox->turns, pile, turn);
    free(pile);
}

/* The oldest one. */
static void *pile_take(struct pile *pile)
{
    struct letter *letter = STAILQ_FIRST(&pile->letters);
    void *sample = letter->sample;
    STAILQ_REMOVE_HEAD(&pile->letters, next);
    pile->count--;
    free(letter);
    return sample;
}

void inbox_put(struct inbox *inbox, uint64_t writer, void *sample)
{
    struct letter *letter = calloc(1, sizeof *letter);
    struct pile *pile = letter ? pile_open(inbox, writer) : NULL;
    if (!pile) {
        free(letter);
        inbox->release(sample);
        return;
    }
    letter->sample = sample;
    STAILQ_INSERT_TAIL(&pile->letters, letter, next);
    if (++pile->count > inbox->most)
        inbox->release(pile_take(pile));
}

void *inbox_take(struct inbox *inbox, uint64_t *writer)
{
    struct pile *pile = TAILQ_FIRST(&inbox->turns);
    if (!pile)
        return NULL;
    void *sample = pile_take(pile);
    *writer = pile->node.key.first;
    TAILQ_REMOVE(&inbox->turns, pile, turn);
    TAILQ_INSERT_TAIL(&inbox->turns, pile, turn);
    pile_drop_if_empty(inbox, pile);
    return sample;
}

bool inbox_is_empty(const struct inbox *inbox)
{
    return TAILQ_EMPTY(&inbox->turns);
}
