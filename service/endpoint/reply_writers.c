/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/reply_writers.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "endpoint/clock.h"
#include "endpoint/key_map.h"
#include "endpoint/subscriptions.h"

static const double stall_pause = 1.0; /* s */

/* A client. */
struct destination {
    struct key_node node; /* key: client */
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

struct reply_writers {
    pthread_mutex_t lock; /* of the destinations and what is in them */
    dds_entity_t participant, source;
    dds_entity_t topics[CHANNEL_COUNT];
    struct key_map destinations, readers;
    LIST_HEAD(destination_list, destination) all_destinations;
    LIST_HEAD(reader_list, remote_reader) all_readers;
};

static const struct {
    const char *topic;
    const dds_topic_descriptor_t *type;
} replies[CHANNEL_COUNT] = {
    [EXCHANGE_SINGLE] = {WIRE_TOPIC_REPLY, &percuss_v1_Reply_desc},
    [EXCHANGE_BATCH] = {WIRE_TOPIC_BATCH_REPLY, &percuss_v1_BatchReply_desc},
    [EXCHANGE_ENSEMBLE] = {WIRE_TOPIC_ENSEMBLE_REPLY, &percuss_v1_EnsembleReply_desc},
    [CHANNEL_PROGRESS] = {WIRE_TOPIC_ENSEMBLE_PROGRESS, &percuss_v1_EnsembleProgress_desc},
    [CHANNEL_TRACE] = {WIRE_TOPIC_TRACE, &percuss_v1_Trace_desc},
    [CHANNEL_SAMPLES] = {WIRE_TOPIC_ENSEMBLE_SAMPLES, &percuss_v1_EnsembleSamples_desc},
};

static bool create_entities(struct reply_writers *writers, struct fault *fault)
{
    for (int i = 0; i < CHANNEL_COUNT; i++) {
        writers->topics[i] =
            wire_topic_create(writers->participant, replies[i].type, replies[i].topic);
        if (writers->topics[i] < 0) {
            fault_set(fault, PERCUSS_INTERNAL, "topic %s: %s", replies[i].topic,
                      dds_strretcode(writers->topics[i]));
            return false;
        }
    }
    writers->source = subscriptions_open(writers->participant, fault);
    return writers->source > 0;
}

struct reply_writers *reply_writers_create(dds_entity_t participant, struct fault *fault)
{
    struct reply_writers *writers = calloc(1, sizeof *writers);
    if (!writers || !key_map_create(&writers->destinations, REPLY_WRITERS_CLIENTS))
        goto no_destinations;
    if (!key_map_create(&writers->readers, REPLY_WRITERS_CLIENTS))
        goto no_readers;
    pthread_mutex_init(&writers->lock, NULL);
    writers->participant = participant;
    if (!create_entities(writers, fault)) {
        reply_writers_free(writers);
        return NULL;
    }
    return writers;
no_readers:
    key_map_release(&writers->destinations);
no_destinations:
    free(writers);
    fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    return NULL;
}

void reply_writers_free(struct reply_writers *writers)
{
    if (!writers)
        return;
    while (!LIST_EMPTY(&writers->all_readers)) {
        struct remote_reader *reader = LIST_FIRST(&writers->all_readers);
        LIST_REMOVE(reader, all);
        free(reader);
    }
    while (!LIST_EMPTY(&writers->all_destinations)) {
        struct destination *destination = LIST_FIRST(&writers->all_destinations);
        LIST_REMOVE(destination, all);
        free(destination);
    }
    key_map_release(&writers->readers);
    key_map_release(&writers->destinations);
    pthread_mutex_destroy(&writers->lock);
    free(writers);
}

dds_entity_t reply_writers_source(const struct reply_writers *writers)
{
    return writers->source;
}

static struct destination *find(const struct reply_writers *writers, const uint8_t client[16])
{
    struct key_node *node = key_map_find(&writers->destinations, digest_of_octets(client));
    return node ? KEY_MAP_OWNER(node, struct destination, node) : NULL;
}

/* The destination, old or new; NULL: too many clients, or no memory. */
static struct destination *find_or_create(struct reply_writers *writers, const uint8_t client[16])
{
    struct destination *destination = find(writers, client);
    if (destination || writers->destinations.count >= REPLY_WRITERS_CLIENTS)
        return destination;
    destination = calloc(1, sizeof *destination);
    if (!destination)
        return NULL;
    destination->node.key = digest_of_octets(client);
    memcpy(destination->client, client, sizeof destination->client);
    key_map_insert(&writers->destinations, &destination->node);
    LIST_INSERT_HEAD(&writers->all_destinations, destination, all);
    return destination;
}

static void drop_if_unread(struct reply_writers *writers, struct destination *destination)
{
    for (int i = 0; i < CHANNEL_COUNT; i++) {
        if (destination->readers[i] > 0)
            return;
    }
    key_map_remove(&writers->destinations, &destination->node);
    LIST_REMOVE(destination, all);
    free(destination);
}

static dds_entity_t create_writer(const struct reply_writers *writers, const uint8_t client[16],
                                  unsigned channel)
{
    char partition[WIRE_PARTITION_SIZE];
    wire_partition_name(client, partition);
    dds_qos_t *qos = wire_qos_exchange(partition);
    dds_entity_t writer =
        dds_create_writer(writers->participant, writers->topics[channel], qos, NULL);
    dds_delete_qos(qos);
    return writer > 0 ? writer : 0;
}

/* A reader came: false if it can get no writer. */
static bool add_reader(struct reply_writers *writers, struct remote_reader *reader,
                       const uint8_t client[16], unsigned channel)
{
    pthread_mutex_lock(&writers->lock);
    struct destination *destination = find_or_create(writers, client);
    if (destination) {
        destination->readers[channel]++;
        if (!destination->writers[channel])
            destination->writers[channel] = create_writer(writers, client, channel);
        reader->destination = destination;
        reader->channel = channel;
        key_map_insert(&writers->readers, &reader->node);
        LIST_INSERT_HEAD(&writers->all_readers, reader, all);
    }
    pthread_mutex_unlock(&writers->lock);
    return destination != NULL;
}

/* A reader went. Writes that go on in other threads meanwhile fail on their own. */
static void remove_reader(struct reply_writers *writers, struct remote_reader *reader)
{
    struct destination *destination = reader->destination;
    unsigned channel = reader->channel;
    dds_entity_t unused = 0;
    pthread_mutex_lock(&writers->lock);
    key_map_remove(&writers->readers, &reader->node);
    LIST_REMOVE(reader, all);
    if (--destination->readers[channel] == 0) {
        unused = destination->writers[channel];
        destination->writers[channel] = 0;
        drop_if_unread(writers, destination);
    }
    pthread_mutex_unlock(&writers->lock);
    free(reader);
    if (unused)
        dds_delete(unused);
}

static unsigned find_channel(const char *topic)
{
    int i = 0;
    while (i < CHANNEL_COUNT && strcmp(topic, replies[i].topic) != 0)
        i++;
    return i;
}

/* What a visit of the subscriptions needs. */
struct follow {
    struct reply_writers *writers;
    presence_function *presence;
    void *context;
};

static void note_gone(const struct follow *follow, struct key_node *node)
{
    struct remote_reader *reader = KEY_MAP_OWNER(node, struct remote_reader, node);
    uint8_t client[16];
    memcpy(client, reader->destination->client, sizeof client);
    remove_reader(follow->writers, reader);
    follow->presence(follow->context, client, READER_GONE);
}

static void note_come(const struct follow *follow, const struct subscription *subscription)
{
    unsigned channel = find_channel(subscription->topic);
    if (channel == CHANNEL_COUNT)
        return;
    struct remote_reader *reader = calloc(1, sizeof *reader);
    enum presence presence = READER_REFUSED;
    if (reader) {
        reader->node.key = subscription->key;
        if (add_reader(follow->writers, reader, subscription->client, channel))
            presence = READER_COME;
        else
            free(reader);
    }
    follow->presence(follow->context, subscription->client, presence);
}

static void follow_one(void *context, const struct subscription *subscription)
{
    const struct follow *follow = context;
    struct key_node *node = key_map_find(&follow->writers->readers, subscription->key);
    if (node && !subscription->alive)
        note_gone(follow, node);
    else if (!node && subscription->alive && subscription->is_client)
        note_come(follow, subscription);
}

void reply_writers_follow(struct reply_writers *writers, presence_function *presence, void *context)
{
    struct follow follow = {writers, presence, context};
    subscriptions_take(writers->source, follow_one, &follow);
}

/* The writer for a client's replies; 0 with the reason if there is none to be used now. */
static dds_entity_t find_writer(struct reply_writers *writers, const uint8_t client[16],
                                unsigned channel, enum delivery *reason)
{
    dds_entity_t writer = 0;
    *reason = DELIVERY_NO_READER;
    pthread_mutex_lock(&writers->lock);
    const struct destination *destination = find(writers, client);
    if (destination && destination->writers[channel]) {
        bool stalled = clock_now() < destination->stalled_until[channel];
        *reason = stalled ? DELIVERY_STALLED : DELIVERY_DONE;
        writer = stalled ? 0 : destination->writers[channel];
    }
    pthread_mutex_unlock(&writers->lock);
    return writer;
}

/* Spares the other clients the wait for one that is stopped or cut off. */
static void mark_stalled(struct reply_writers *writers, const uint8_t client[16], unsigned channel)
{
    pthread_mutex_lock(&writers->lock);
    struct destination *destination = find(writers, client);
    if (destination)
        destination->stalled_until[channel] = clock_now() + stall_pause;
    pthread_mutex_unlock(&writers->lock);
}

/* What became of a sample. */
static enum delivery judge(struct reply_writers *writers, const uint8_t client[16],
                           unsigned channel, dds_return_t result)
{
    if (result == DDS_RETCODE_TIMEOUT) {
        mark_stalled(writers, client, channel);
        return DELIVERY_STALLED;
    }
    return result == DDS_RETCODE_OK ? DELIVERY_DONE : DELIVERY_NO_READER;
}

static dds_return_t write_all(dds_entity_t writer, const struct answer *answer)
{
    if (answer->exchange == EXCHANGE_ENSEMBLE)
        return dds_write(writer, answer->report);
    if (answer->exchange == EXCHANGE_SINGLE)
        return dds_write(writer, answer->reply);
    dds_return_t result = DDS_RETCODE_OK;
    for (size_t i = 0; !result && i < answer->part_count; i++)
        result = dds_write(writer, &answer->parts[i]);
    return result;
}

/* The histories go first, to a client that reads such: the reply tells that all were written. */
static void write_traces(struct reply_writers *writers, const uint8_t client[16],
                         const struct answer *answer)
{
    enum delivery delivery;
    dds_entity_t writer = find_writer(writers, client, CHANNEL_TRACE, &delivery);
    dds_return_t result = DDS_RETCODE_OK;
    for (size_t i = 0; writer && !result && i < answer->trace_count; i++)
        result = dds_write(writer, &answer->traces[i]);
    judge(writers, client, CHANNEL_TRACE, result);
}

enum delivery reply_writers_write(struct reply_writers *writers, const uint8_t client[16],
                                  const struct answer *answer)
{
    enum delivery delivery;
    dds_entity_t writer = find_writer(writers, client, answer->exchange, &delivery);
    if (!writer)
        return delivery;
    if (answer->trace_count > 0)
        write_traces(writers, client, answer);
    dds_return_t result = write_all(writer, answer);
    return judge(writers, client, answer->exchange, result);
}

enum delivery reply_writers_publish(struct reply_writers *writers, const uint8_t client[16],
                                    unsigned channel, const void *sample, unsigned patience)
{
    enum delivery delivery;
    dds_entity_t writer = find_writer(writers, client, channel, &delivery);
    if (!writer)
        return delivery;
    dds_return_t result = dds_write(writer, sample);
    for (unsigned i = 1; result == DDS_RETCODE_TIMEOUT && i < patience; i++)
        result = dds_write(writer, sample);
    return judge(writers, client, channel, result);
}

void reply_writers_flush(struct reply_writers *writers, double seconds)
{
    double end = clock_now() + seconds;
    pthread_mutex_lock(&writers->lock);
    struct destination *destination;
    LIST_FOREACH(destination, &writers->all_destinations, all)
    {
        for (int i = 0; i < CHANNEL_COUNT; i++) {
            double left = end - clock_now();
            if (destination->writers[i] && left > 0.0)
                dds_wait_for_acks(destination->writers[i], (dds_duration_t)(left * 1e9));
        }
    }
    pthread_mutex_unlock(&writers->lock);
}

size_t reply_writers_count(struct reply_writers *writers)
{
    pthread_mutex_lock(&writers->lock);
    size_t count = writers->destinations.count;
    pthread_mutex_unlock(&writers->lock);
    return count;
}
