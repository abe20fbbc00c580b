/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/token_store.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "exchange/key_map.h"
#include "exchange/text.h"

static const char digits[] = "0123456789abcdef";

struct stored_state {
    struct key_node node;
    TAILQ_ENTRY(stored_state) order;
    unsigned holders; /* the store itself is one while the state can be asked for */
    size_t size;      /* of the state */
    double used;      /* time of the last use */
    char revision[PERCUSS_ID_SIZE];
    char body[TOKEN_BODY_SIZE];
    _Alignas(max_align_t) unsigned char state[];
};

struct token_store {
    pthread_mutex_t lock;
    struct token_limits limits;
    struct key_map map;
    TAILQ_HEAD(state_order, stored_state) order; /* least recently used first */
    size_t bytes;
};

struct token_store *token_store_create(const struct token_limits *limits)
{
    struct token_store *store = calloc(1, sizeof *store);
    if (!store)
        return NULL;
    if (!key_map_create(&store->map, limits->count)) {
        free(store);
        return NULL;
    }
    store->limits = *limits;
    TAILQ_INIT(&store->order);
    pthread_mutex_init(&store->lock, NULL);
    return store;
}

static void let_go(struct stored_state *stored)
{
    if (--stored->holders == 0)
        free(stored);
}

static void drop(struct token_store *store, struct stored_state *stored)
{
    key_map_remove(&store->map, &stored->node);
    TAILQ_REMOVE(&store->order, stored, order);
    store->bytes -= sizeof *stored + stored->size;
    let_go(stored);
}

static void drop_excess(struct token_store *store, double now)
{
    struct stored_state *oldest;
    while ((oldest = TAILQ_FIRST(&store->order)) &&
           (store->map.count > store->limits.count || store->bytes > store->limits.bytes ||
            now - oldest->used > store->limits.seconds))
        drop(store, oldest);
}

void token_store_free(struct token_store *store)
{
    if (!store)
        return;
    while (!TAILQ_EMPTY(&store->order))
        drop(store, TAILQ_FIRST(&store->order));
    key_map_release(&store->map);
    pthread_mutex_destroy(&store->lock);
    free(store);
}

static void touch(struct token_store *store, struct stored_state *stored, double now)
{
    stored->used = now;
    TAILQ_REMOVE(&store->order, stored, order);
    TAILQ_INSERT_TAIL(&store->order, stored, order);
}

static struct digest token_digest(const struct token_subject *subject,
                                  const struct body_state *state, size_t size)
{
    struct hasher hasher = {0};
    hash_text(&hasher, subject->revision);
    hash_text(&hasher, subject->body);
    hash_bytes(&hasher, state, size);
    return hash_digest(&hasher);
}

static bool is_of(const struct stored_state *stored, const struct token_subject *subject)
{
    return strcmp(stored->revision, subject->revision) == 0 &&
           strcmp(stored->body, subject->body) == 0;
}

static struct stored_state *stored_create(struct digest key, const struct token_subject *subject,
                                          const struct body_state *state, size_t size)
{
    struct stored_state *stored = malloc(sizeof *stored + size);
    if (!stored)
        return NULL;
    *stored = (struct stored_state){.node.key = key, .holders = 1, .size = size};
    COPY_TEXT(stored->revision, subject->revision);
    COPY_TEXT(stored->body, subject->body);
    memcpy(stored->state, state, size);
    return stored;
}

static bool is_same(const struct stored_state *stored, const struct token_subject *subject,
                    const struct body_state *state, size_t size)
{
    return is_of(stored, subject) && stored->size == size &&
           memcmp(stored->state, state, size) == 0;
}

/* The stored state of that token, even if it differs, or else this one; NULL: out of memory. */
static struct stored_state *find_or_store(struct token_store *store, struct digest key,
                                          const struct token_subject *subject,
                                          const struct body_state *state, size_t size)
{
    struct key_node *node = key_map_find(&store->map, key);
    if (node)
        return KEY_MAP_OWNER(node, struct stored_state, node);
    struct stored_state *stored = stored_create(key, subject, state, size);
    if (stored) {
        key_map_insert(&store->map, &stored->node);
        TAILQ_INSERT_TAIL(&store->order, stored, order);
        store->bytes += sizeof *stored + size;
    }
    return stored;
}

/* 32 lower-case hexadecimal digits. */
static void print_token(struct digest key, char token[PERCUSS_ID_SIZE])
{
    for (int i = 0; i < 16; i++) {
        token[i] = digits[key.first >> (60 - 4 * i) & 15];
        token[16 + i] = digits[key.second >> (60 - 4 * i) & 15];
    }
    token[32] = '\0';
}

bool token_store_put(struct token_store *store, const struct token_subject *subject,
                     const struct body_state *state, double now, char token[PERCUSS_ID_SIZE])
{
    size_t size = body_state_size(state);
    struct digest key = token_digest(subject, state, size);
    token[0] = '\0';
    pthread_mutex_lock(&store->lock);
    struct stored_state *stored = find_or_store(store, key, subject, state, size);
    bool good = stored != NULL;
    if (good && is_same(stored, subject, state, size)) {
        touch(store, stored, now);
        print_token(key, token);
        drop_excess(store, now);
    }
    pthread_mutex_unlock(&store->lock);
    return good;
}

/* The inverse of print_token, of its format alone. */
static bool parse_token(const char *token, struct digest *key)
{
    *key = (struct digest){0};
    if (strlen(token) != 32)
        return false;
    for (int i = 0; i < 32; i++) {
        const char *digit = strchr(digits, token[i]);
        if (!digit)
            return false;
        uint64_t *half = i < 16 ? &key->first : &key->second;
        *half = *half << 4 | (uint64_t)(digit - digits);
    }
    return true;
}

static struct stored_state *token_store_find(struct token_store *store, const char *token,
                                             const struct token_subject *subject,
                                             struct fault *fault)
{
    struct digest key;
    /* any state of that token */
    struct key_node *node = parse_token(token, &key) ? key_map_find(&store->map, key) : NULL;
    if (!node) {
        fault_set(fault, PERCUSS_UNKNOWN_STATE,
                  "%s: not known (any more): must be a token of a recent reply of this server",
                  token);
        return NULL;
    }
    struct stored_state *stored = KEY_MAP_OWNER(node, struct stored_state, node);
    /* of this body and catalogue */
    if (strcmp(stored->body, subject->body) != 0) {
        fault_set(fault, PERCUSS_UNKNOWN_STATE, "%s: is a state of %s: must be one of %s", token,
                  stored->body, subject->body);
        return NULL;
    }
    if (!is_of(stored, subject)) {
        fault_set(fault, PERCUSS_UNKNOWN_STATE,
                  "%s: belongs to catalogue revision %s: must be of the present one, %s", token,
                  stored->revision, subject->revision);
        return NULL;
    }
    return stored;
}

const struct body_state *token_store_hold(struct token_store *store, const char *token,
                                          const struct token_subject *subject, double now,
                                          struct fault *fault)
{
    pthread_mutex_lock(&store->lock);
    drop_excess(store, now);
    struct stored_state *stored = token_store_find(store, token, subject, fault);
    if (stored) {
        stored->holders++;
        touch(store, stored, now);
    }
    pthread_mutex_unlock(&store->lock);
    return stored ? (const struct body_state *)stored->state : NULL;
}

void token_store_release(struct token_store *store, const struct body_state *state)
{
    const unsigned char *bytes = (const unsigned char *)state;
    pthread_mutex_lock(&store->lock);
    let_go((struct stored_state *)(bytes - offsetof(struct stored_state, state)));
    pthread_mutex_unlock(&store->lock);
}

void token_store_sweep(struct token_store *store, double now)
{
    pthread_mutex_lock(&store->lock);
    drop_excess(store, now);
    pthread_mutex_unlock(&store->lock);
}

size_t token_store_count(struct token_store *store)
{
    pthread_mutex_lock(&store->lock);
    size_t count = store->map.count;
    pthread_mutex_unlock(&store->lock);
    return count;
}

size_t token_store_bytes(struct token_store *store)
{
    pthread_mutex_lock(&store->lock);
    size_t bytes = store->bytes;
    pthread_mutex_unlock(&store->lock);
    return bytes;
}
