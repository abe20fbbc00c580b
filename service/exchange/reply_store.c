/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/reply_store.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "exchange/key_map.h"

enum { EXPECTED_CLIENTS = 256, EXPECTED_REPLIES = 128 };

struct session;

struct kept_reply {
    struct key_node node;         /* key: sequence, exchange */
    TAILQ_ENTRY(kept_reply) age;  /* among all */
    TAILQ_ENTRY(kept_reply) turn; /* in its session */
    struct session *session;
    struct digest content;
    struct answer *answer; /* NULL: pending */
};

struct session {
    struct key_node node; /* key: client */
    TAILQ_ENTRY(session) order;
    struct key_map replies;
    TAILQ_HEAD(reply_turns, kept_reply) turns; /* oldest first */
    unsigned readers;                          /* of replies, that are there */
    bool was_present;
    double seen; /* last request, or when its reader went */
};

struct reply_store {
    pthread_mutex_t lock;
    struct reply_limits limits;
    struct key_map sessions;
    TAILQ_HEAD(session_order, session) order; /* least recently seen first */
    TAILQ_HEAD(reply_ages, kept_reply) ages;  /* oldest first */
    size_t bytes;
};

struct reply_store *reply_store_create(const struct reply_limits *limits)
{
    struct reply_store *store = calloc(1, sizeof *store);
    if (!store)
        return NULL;
    if (!key_map_create(&store->sessions, EXPECTED_CLIENTS)) {
        free(store);
        return NULL;
    }
    store->limits = *limits;
    TAILQ_INIT(&store->order);
    TAILQ_INIT(&store->ages);
    pthread_mutex_init(&store->lock, NULL);
    return store;
}

static size_t reply_bytes(const struct kept_reply *reply)
{
    return sizeof *reply + (reply->answer ? reply->answer->bytes : 0);
}

static void reply_drop(struct reply_store *store, struct kept_reply *reply)
{
    key_map_remove(&reply->session->replies, &reply->node);
    TAILQ_REMOVE(&reply->session->turns, reply, turn);
    TAILQ_REMOVE(&store->ages, reply, age);
    store->bytes -= reply_bytes(reply);
    answer_release(reply->answer);
    free(reply);
}

static void session_drop(struct reply_store *store, struct session *session)
{
    while (!TAILQ_EMPTY(&session->turns))
        reply_drop(store, TAILQ_FIRST(&session->turns));
    key_map_release(&session->replies);
    key_map_remove(&store->sessions, &session->node);
    TAILQ_REMOVE(&store->order, session, order);
    free(session);
}

void reply_store_free(struct reply_store *store)
{
    if (!store)
        return;
    while (!TAILQ_EMPTY(&store->order))
        session_drop(store, TAILQ_FIRST(&store->order));
    key_map_release(&store->sessions);
    pthread_mutex_destroy(&store->lock);
    free(store);
}

static void session_seen(struct reply_store *store, struct session *session, double now)
{
    session->seen = now;
    TAILQ_REMOVE(&store->order, session, order);
    TAILQ_INSERT_TAIL(&store->order, session, order);
}

/* Sessions of present clients stay, however long they send nothing. */
static void drop_gone(struct reply_store *store, double now)
{
    struct session *next;
    for (struct session *session = TAILQ_FIRST(&store->order); session; session = next) {
        next = TAILQ_NEXT(session, order);
        bool expired = now - session->seen > store->limits.seconds;
        if (!expired && store->sessions.count <= store->limits.clients)
            return;
        if (session->readers == 0)
            session_drop(store, session);
    }
}

static struct session *session_find(const struct reply_store *store, const uint8_t client[16])
{
    struct key_node *node = key_map_find(&store->sessions, digest_of_octets(client));
    return node ? KEY_MAP_OWNER(node, struct session, node) : NULL;
}

/* The session, old or new; NULL: out of memory. */
static struct session *session_open(struct reply_store *store, const uint8_t client[16], double now)
{
    struct session *session = session_find(store, client);
    if (session) {
        session_seen(store, session, now);
        return session;
    }
    /* a client that is new or was forgotten */
    session = calloc(1, sizeof *session);
    if (!session)
        return NULL;
    if (!key_map_create(&session->replies, EXPECTED_REPLIES)) {
        free(session);
        return NULL;
    }
    session->node.key = digest_of_octets(client);
    session->seen = now;
    TAILQ_INIT(&session->turns);
    key_map_insert(&store->sessions, &session->node);
    TAILQ_INSERT_TAIL(&store->order, session, order);
    return session;
}

static struct kept_reply *reply_find(const struct session *session, const struct request_name *name)
{
    struct digest key = {name->sequence, name->exchange};
    struct key_node *node = key_map_find(&session->replies, key);
    return node ? KEY_MAP_OWNER(node, struct kept_reply, node) : NULL;
}

/* False: out of memory. */
static bool reply_open(struct reply_store *store, struct session *session,
                       const struct request_name *name, struct digest content)
{
    struct kept_reply *reply = calloc(1, sizeof *reply);
    if (!reply)
        return false;
    reply->node.key = (struct digest){name->sequence, name->exchange};
    reply->session = session;
    reply->content = content;
    key_map_insert(&session->replies, &reply->node);
    TAILQ_INSERT_TAIL(&session->turns, reply, turn);
    TAILQ_INSERT_TAIL(&store->ages, reply, age);
    store->bytes += reply_bytes(reply);
    while (session->replies.count > store->limits.per_client)
        reply_drop(store, TAILQ_FIRST(&session->turns));
    return true;
}

static enum admission judge(const struct kept_reply *reply, struct digest content)
{
    if (reply->content.first != content.first || reply->content.second != content.second)
        return ADMISSION_CONFLICT;
    return reply->answer ? ADMISSION_REPEATED : ADMISSION_PENDING;
}

enum admission reply_store_admit(struct reply_store *store, const struct request_name *name,
                                 struct digest content, double now, struct answer **answer)
{
    enum admission admission = ADMISSION_NO_MEMORY;
    *answer = NULL;
    pthread_mutex_lock(&store->lock);
    struct session *session = session_open(store, name->client, now);
    struct kept_reply *reply = session ? reply_find(session, name) : NULL;
    if (reply) {
        admission = judge(reply, content);
        if (admission == ADMISSION_REPEATED)
            *answer = answer_hold(reply->answer);
    } else if (session && reply_open(store, session, name, content)) {
        admission = ADMISSION_NEW;
        drop_gone(store, now);
    }
    pthread_mutex_unlock(&store->lock);
    return admission;
}

/* The pending entry of an admitted request; NULL if it was pushed out meanwhile. */
static struct kept_reply *find_pending(const struct reply_store *store,
                                       const struct request_name *name)
{
    struct session *session = session_find(store, name->client);
    struct kept_reply *reply = session ? reply_find(session, name) : NULL;
    return reply && !reply->answer ? reply : NULL;
}

void reply_store_keep(struct reply_store *store, const struct request_name *name,
                      struct answer *answer)
{
    pthread_mutex_lock(&store->lock);
    struct kept_reply *reply = find_pending(store, name);
    if (reply) {
        reply->answer = answer_hold(answer);
        store->bytes += answer->bytes;
    }
    while (store->bytes > store->limits.bytes && !TAILQ_EMPTY(&store->ages))
        reply_drop(store, TAILQ_FIRST(&store->ages));
    pthread_mutex_unlock(&store->lock);
}

void reply_store_forget(struct reply_store *store, const struct request_name *name)
{
    pthread_mutex_lock(&store->lock);
    struct kept_reply *reply = find_pending(store, name);
    if (reply)
        reply_drop(store, reply);
    pthread_mutex_unlock(&store->lock);
}

bool reply_store_set_present(struct reply_store *store, const uint8_t client[16], bool present,
                             double now)
{
    pthread_mutex_lock(&store->lock);
    struct session *session =
        present ? session_open(store, client, now) : session_find(store, client);
    if (session && present) {
        session->readers++;
        session->was_present = true;
    } else if (session && session->readers > 0) {
        session->readers--;
        session_seen(store, session, now);
    }
    pthread_mutex_unlock(&store->lock);
    return session || !present;
}

bool reply_store_is_gone(struct reply_store *store, const uint8_t client[16])
{
    pthread_mutex_lock(&store->lock);
    const struct session *session = session_find(store, client);
    bool gone = session && session->was_present && session->readers == 0;
    pthread_mutex_unlock(&store->lock);
    return gone;
}

void reply_store_sweep(struct reply_store *store, double now)
{
    pthread_mutex_lock(&store->lock);
    drop_gone(store, now);
    pthread_mutex_unlock(&store->lock);
}

size_t reply_store_clients(struct reply_store *store)
{
    pthread_mutex_lock(&store->lock);
    size_t count = store->sessions.count;
    pthread_mutex_unlock(&store->lock);
    return count;
}

size_t reply_store_bytes(struct reply_store *store)
{
    pthread_mutex_lock(&store->lock);
    size_t bytes = store->bytes;
    pthread_mutex_unlock(&store->lock);
    return bytes;
}
