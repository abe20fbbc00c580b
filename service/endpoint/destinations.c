/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/destinations.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "exchange/clock.h"
#include "exchange/key_map.h"

enum { EXPECTED = 1024 };
static const double STALL_PAUSE = 1.0; /* s */

/* A client. */
struct destination {
    struct key_node node;      /* key: client */
    struct digest participant; /* of its first reader */
    LIST_ENTRY(destination) all;
    uint8_t client[16];
    unsigned readers[CHANNEL_COUNT];
    dds_entity_t writers[CHANNEL_COUNT]; /* 0: none */
    double stalled_until[CHANNEL_COUNT];
};

/* A reader of replies somewhere in the domain; when it goes, only its key is told. */
struct remote_reader {
    struct key_node node; /* key: GUID */
    LIST_ENTRY(remote_reader) all;
    struct destination *destination;
    unsigned channel;
};

struct destinations {
    size_t most;
    writer_maker *make;
    void *context;        /* of that */
    pthread_mutex_t lock; /* of the clients and their members */
    struct key_map clients;
    LIST_HEAD(destination_list, destination) all_clients;
    /* of the thread that adds and removes them */
    struct key_map readers;
    LIST_HEAD(reader_list, remote_reader) all_readers;
};

struct destinations *destinations_create(size_t most, writer_maker *make, void *context)
{
    struct destinations *destinations = calloc(1, sizeof *destinations);
    if (!destinations)
        return NULL;
    destinations->most = most;
    destinations->make = make;
    destinations->context = context;
    pthread_mutex_init(&destinations->lock, NULL);
    if (key_map_create(&destinations->clients, EXPECTED) &&
        key_map_create(&destinations->readers, EXPECTED))
        return destinations;
    destinations_free(destinations);
    return NULL;
}

void destinations_free(struct destinations *destinations)
{
    if (!destinations)
        return;
    while (!LIST_EMPTY(&destinations->all_readers)) {
        struct remote_reader *reader = LIST_FIRST(&destinations->all_readers);
        LIST_REMOVE(reader, all);
        free(reader);
    }
    while (!LIST_EMPTY(&destinations->all_clients)) {
        struct destination *destination = LIST_FIRST(&destinations->all_clients);
        LIST_REMOVE(destination, all);
        free(destination);
    }
    key_map_release(&destinations->readers);
    key_map_release(&destinations->clients);
    pthread_mutex_destroy(&destinations->lock);
    free(destinations);
}

static struct destination *find(const struct destinations *destinations, const uint8_t client[16])
{
    struct key_node *node = key_map_find(&destinations->clients, digest_of_octets(client));
    return node ? KEY_MAP_OWNER(node, struct destination, node) : NULL;
}

/* Whether a participant may bring another client: one alone leaves half of the places to others. */
static bool has_place(const struct destinations *destinations, struct digest participant)
{
    const struct destination *destination;
    size_t half = (destinations->most + 1) / 2, count = 0;
    if (destinations->clients.count < half)
        return true;
    LIST_FOREACH(destination, &destinations->all_clients, all)
    {
        count += destination->participant.first == participant.first &&
                 destination->participant.second == participant.second;
    }
    return count < half && destinations->clients.count < destinations->most;
}

/* The destination, old or new; NULL: too many clients, or no memory. */
static struct destination *find_or_create(struct destinations *destinations,
                                          const struct destination_reader *reader)
{
    struct destination *destination = find(destinations, reader->client);
    if (destination || !has_place(destinations, reader->participant))
        return destination;
    destination = calloc(1, sizeof *destination);
    if (!destination)
        return NULL;
    destination->node.key = digest_of_octets(reader->client);
    destination->participant = reader->participant;
    memcpy(destination->client, reader->client, sizeof destination->client);
    key_map_insert(&destinations->clients, &destination->node);
    LIST_INSERT_HEAD(&destinations->all_clients, destination, all);
    return destination;
}

static void drop_if_unread(struct destinations *destinations, struct destination *destination)
{
    for (int i = 0; i < CHANNEL_COUNT; i++) {
        if (destination->readers[i] > 0)
            return;
    }
    key_map_remove(&destinations->clients, &destination->node);
    LIST_REMOVE(destination, all);
    free(destination);
}

bool destinations_know(const struct destinations *destinations, struct digest reader)
{
    return key_map_find(&destinations->readers, reader) != NULL;
}

bool destinations_add(struct destinations *destinations, const struct destination_reader *reader)
{
    unsigned channel = reader->channel;
    struct remote_reader *added = calloc(1, sizeof *added);
    if (!added)
        return false;
    /* the client's writer of this channel, made for its first reader */
    pthread_mutex_lock(&destinations->lock);
    struct destination *destination = find_or_create(destinations, reader);
    if (destination) {
        destination->readers[channel]++;
        if (!destination->writers[channel])
            destination->writers[channel] =
                destinations->make(destinations->context, reader->client, channel);
    }
    pthread_mutex_unlock(&destinations->lock);
    if (!destination) {
        free(added);
        return false;
    }
    /* by this key the reader is known when it goes */
    added->node.key = reader->key;
    added->destination = destination;
    added->channel = channel;
    key_map_insert(&destinations->readers, &added->node);
    LIST_INSERT_HEAD(&destinations->all_readers, added, all);
    return true;
}

dds_entity_t destinations_remove(struct destinations *destinations, struct digest reader,
                                 uint8_t client[16])
{
    struct key_node *node = key_map_find(&destinations->readers, reader);
    struct remote_reader *gone = KEY_MAP_OWNER(node, struct remote_reader, node);
    struct destination *destination = gone->destination;
    dds_entity_t unread = 0;
    /* writes that go on in other threads meanwhile fail on their own */
    pthread_mutex_lock(&destinations->lock);
    memcpy(client, destination->client, sizeof destination->client);
    if (--destination->readers[gone->channel] == 0) {
        unread = destination->writers[gone->channel];
        destination->writers[gone->channel] = 0;
        drop_if_unread(destinations, destination);
    }
    pthread_mutex_unlock(&destinations->lock);
    key_map_remove(&destinations->readers, node);
    LIST_REMOVE(gone, all);
    free(gone);
    return unread;
}

dds_entity_t destinations_writer(struct destinations *destinations, const uint8_t client[16],
                                 unsigned channel, enum delivery *reason)
{
    dds_entity_t writer = 0;
    *reason = DELIVERY_NO_READER;
    pthread_mutex_lock(&destinations->lock);
    const struct destination *destination = find(destinations, client);
    if (destination && destination->writers[channel]) {
        bool stalled = clock_now() < destination->stalled_until[channel];
        *reason = stalled ? DELIVERY_STALLED : DELIVERY_DONE;
        writer = stalled ? 0 : destination->writers[channel];
    }
    pthread_mutex_unlock(&destinations->lock);
    return writer;
}

void destinations_stall(struct destinations *destinations, const uint8_t client[16],
                        unsigned channel)
{
    pthread_mutex_lock(&destinations->lock);
    struct destination *destination = find(destinations, client);
    if (destination)
        destination->stalled_until[channel] = clock_now() + STALL_PAUSE;
    pthread_mutex_unlock(&destinations->lock);
}

void destinations_visit(struct destinations *destinations,
                        void (*visit)(void *context, dds_entity_t writer), void *context)
{
    struct destination *destination;
    pthread_mutex_lock(&destinations->lock);
    LIST_FOREACH(destination, &destinations->all_clients, all)
    {
        for (int i = 0; i < CHANNEL_COUNT; i++) {
            if (destination->writers[i])
                visit(context, destination->writers[i]);
        }
    }
    pthread_mutex_unlock(&destinations->lock);
}

size_t destinations_count(struct destinations *destinations)
{
    pthread_mutex_lock(&destinations->lock);
    size_t count = destinations->clients.count;
    pthread_mutex_unlock(&destinations->lock);
    return count;
}
