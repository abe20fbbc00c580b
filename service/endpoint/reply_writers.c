/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/reply_writers.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/queue.h>

#include "exchange/clock.h"
#include "exchange/key_map.h"

/* The clients and their readers. */

enum { EXPECTED_CLIENTS = 1024 };
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
    if (key_map_create(&destinations->clients, EXPECTED_CLIENTS) &&
        key_map_create(&destinations->readers, EXPECTED_CLIENTS))
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

static struct destination *destination_find(const struct destinations *destinations,
                                            const uint8_t client[16])
{
    struct key_node *node = key_map_find(&destinations->clients, digest_of_octets(client));
    return node ? KEY_MAP_OWNER(node, struct destination, node) : NULL;
}

/* Whether a participant may bring another client: one alone leaves half of the places to others. */
static bool destination_has_place(const struct destinations *destinations,
                                  struct digest participant)
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
static struct destination *destination_open(struct destinations *destinations,
                                            const struct destination_reader *reader)
{
    struct destination *destination = destination_find(destinations, reader->client);
    if (destination || !destination_has_place(destinations, reader->participant))
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

static void destination_drop_if_unread(struct destinations *destinations,
                                       struct destination *destination)
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
    struct destination *destination = destination_open(destinations, reader);
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
        destination_drop_if_unread(destinations, destination);
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
    const struct destination *destination = destination_find(destinations, client);
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
    struct destination *destination = destination_find(destinations, client);
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

/* The readers of replies that come and go in the domain, as DDS's built-in topic shows them. */

enum { TAKEN_AT_ONCE = 32 };

/* A reader that has come or gone; of one that has gone only the key is told. */
struct subscription {
    struct digest key;
    struct digest participant; /* of DDS, which it belongs to */
    bool alive;
    bool is_client; /* it reads in a client's partition: that client's */
    uint8_t client[16];
    const char *topic; /* borrowed */
};

/* The reader of the built-in topic, which the participant's end closes; 0 with a fault. */
static dds_entity_t subscriptions_open(dds_entity_t participant, struct fault *fault)
{
    dds_entity_t reader =
        dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, NULL, NULL);
    if (reader > 0)
        return reader;
    fault_set(fault, PERCUSS_INTERNAL, "reader of subscriptions: %s", dds_strretcode(reader));
    return 0;
}

/* The client, of those that ask in `partition`, that this partition of replies is for. */
static bool subscription_parse(const char *name, const char *partition, uint8_t client[16])
{
    char whole[WIRE_REPLIES_SIZE];
    if (name[0] != 'c' || name[1] != '_' || strspn(name + 2, "0123456789abcdef") != 32)
        return false;
    for (size_t i = 0; i < 16; i++)
        sscanf(name + 2 + 2 * i, "%2hhx", &client[i]);
    wire_partition_of_replies(client, partition, whole);
    return strcmp(name, whole) == 0;
}

/* Looks for a client's partition among those of a reader; the first one counts. */
static bool subscription_client(const dds_qos_t *qos, const char *partition, uint8_t client[16])
{
    uint32_t count = 0;
    char **names = NULL;
    bool found = false;
    if (!dds_qget_partition(qos, &count, &names))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        found = found || subscription_parse(names[i], partition, client);
        dds_free(names[i]);
    }
    dds_free(names);
    return found;
}

/* Shows the changes since the last call; clients are those that ask in `partition`. */
static void subscriptions_take(dds_entity_t reader, const char *partition,
                               void (*visit)(void *context,
                                             const struct subscription *subscription),
                               void *context)
{
    void *samples[TAKEN_AT_ONCE] = {NULL};
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t count;
    while ((count = dds_take(reader, samples, infos, TAKEN_AT_ONCE, TAKEN_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < count; i++) {
            const dds_builtintopic_endpoint_t *endpoint = samples[i];
            /* of a reader that has gone no more than the key is told */
            struct subscription subscription = {
                .key = digest_of_octets(endpoint->key.v),
                .alive = infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE,
                .topic = infos[i].valid_data ? endpoint->topic_name : "",
            };
            if (infos[i].valid_data)
                subscription.participant = digest_of_octets(endpoint->participant_key.v);
            subscription.is_client =
                infos[i].valid_data &&
                subscription_client(endpoint->qos, partition, subscription.client);
            visit(context, &subscription);
        }
        dds_return_loan(reader, samples, count);
    }
}

/* The writers. */

struct reply_writers {
    dds_entity_t participant, source;
    const char *partition; /* of the requests */
    dds_entity_t topics[CHANNEL_COUNT];
    struct destinations *destinations;
    struct authorisation *authorisation;
};

static const struct {
    const char *topic;
    const dds_topic_descriptor_t *type;
} reply_topics[CHANNEL_COUNT] = {
    [EXCHANGE_SINGLE] = {WIRE_TOPIC_REPLY, &percuss_v1_Reply_desc},
    [EXCHANGE_BATCH] = {WIRE_TOPIC_BATCH_REPLY, &percuss_v1_BatchReply_desc},
    [EXCHANGE_ENSEMBLE] = {WIRE_TOPIC_ENSEMBLE_REPLY, &percuss_v1_EnsembleReply_desc},
    [CHANNEL_PROGRESS] = {WIRE_TOPIC_ENSEMBLE_PROGRESS, &percuss_v1_EnsembleProgress_desc},
    [CHANNEL_TRACE] = {WIRE_TOPIC_TRACE, &percuss_v1_Trace_desc},
    [CHANNEL_SAMPLES] = {WIRE_TOPIC_ENSEMBLE_SAMPLES, &percuss_v1_EnsembleSamples_desc},
};

static bool reply_writers_open(struct reply_writers *writers, struct fault *fault)
{
    for (int i = 0; i < CHANNEL_COUNT; i++) {
        writers->topics[i] =
            wire_topic_create(writers->participant, reply_topics[i].type, reply_topics[i].topic);
        if (writers->topics[i] < 0) {
            fault_set(fault, PERCUSS_INTERNAL, "topic %s: %s", reply_topics[i].topic,
                      dds_strretcode(writers->topics[i]));
            return false;
        }
    }
    writers->source = subscriptions_open(writers->participant, fault);
    return writers->source > 0;
}

static dds_entity_t create_writer(void *context, const uint8_t client[16], unsigned channel)
{
    const struct reply_writers *writers = context;
    char name[WIRE_REPLIES_SIZE];
    wire_partition_of_replies(client, writers->partition, name);
    dds_qos_t *qos = wire_qos_exchange(name);
    dds_entity_t writer =
        dds_create_writer(writers->participant, writers->topics[channel], qos, NULL);
    dds_delete_qos(qos);
    return writer > 0 ? writer : 0;
}

struct reply_writers *reply_writers_create(dds_entity_t participant, const char *partition,
                                           size_t clients, struct fault *fault)
{
    struct reply_writers *writers = calloc(1, sizeof *writers);
    if (writers)
        writers->destinations = destinations_create(clients, create_writer, writers);
    if (writers)
        writers->authorisation = authorisation_create();
    if (!writers || !writers->destinations || !writers->authorisation) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        reply_writers_free(writers);
        return NULL;
    }
    writers->participant = participant;
    writers->partition = partition;
    if (reply_writers_open(writers, fault))
        return writers;
    reply_writers_free(writers);
    return NULL;
}

void reply_writers_free(struct reply_writers *writers)
{
    if (!writers)
        return;
    destinations_free(writers->destinations);
    authorisation_free(writers->authorisation);
    free(writers);
}

struct authorisation *reply_writers_authorisation(const struct reply_writers *writers)
{
    return writers->authorisation;
}

dds_entity_t reply_writers_source(const struct reply_writers *writers)
{
    return writers->source;
}

static unsigned find_channel(const char *topic)
{
    int i = 0;
    while (i < CHANNEL_COUNT && strcmp(topic, reply_topics[i].topic) != 0)
        i++;
    return i;
}

/* The context of a visit of the subscriptions. */
struct follow {
    struct destinations *destinations;
    struct authorisation *authorisation;
    presence_function *presence;
    void *context;
};

static void follow_one(void *context, const struct subscription *subscription)
{
    const struct follow *follow = context;
    struct destinations *destinations = follow->destinations;
    bool known = destinations_know(destinations, subscription->key);
    struct digest participant = authorisation_participant(subscription->key);
    /* a reader goes, and with the last one of its kind the writer */
    if (known && !subscription->alive) {
        uint8_t client[16];
        dds_entity_t unread = destinations_remove(destinations, subscription->key, client);
        if (unread)
            dds_delete(unread);
        authorisation_remove(follow->authorisation, client, participant);
        follow->presence(follow->context, client, READER_GONE);
    }
    /* a client's reader comes */
    unsigned channel = find_channel(subscription->topic);
    if (known || !subscription->alive || !subscription->is_client || channel == CHANNEL_COUNT)
        return;
    struct destination_reader reader = {subscription->key, subscription->participant,
                                        subscription->client, channel};
    bool good = destinations_add(destinations, &reader);
    if (good)
        authorisation_add(follow->authorisation, subscription->client, participant);
    follow->presence(follow->context, subscription->client, good ? READER_COME : READER_REFUSED);
}

void reply_writers_follow(struct reply_writers *writers, presence_function *presence, void *context)
{
    struct follow follow = {writers->destinations, writers->authorisation, presence, context};
    subscriptions_take(writers->source, writers->partition, follow_one, &follow);
}

/* The outcome of a write. A client that does not take a sample is stopped or cut off. */
static enum delivery delivery_of(struct reply_writers *writers, const uint8_t client[16],
                                 unsigned channel, dds_return_t result)
{
    if (result == DDS_RETCODE_TIMEOUT) {
        destinations_stall(writers->destinations, client, channel);
        return DELIVERY_STALLED;
    }
    return result == DDS_RETCODE_OK ? DELIVERY_DONE : DELIVERY_NO_READER;
}

static dds_return_t answer_write(dds_entity_t writer, const struct answer *answer)
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
    dds_entity_t writer =
        destinations_writer(writers->destinations, client, CHANNEL_TRACE, &delivery);
    dds_return_t result = DDS_RETCODE_OK;
    for (size_t i = 0; writer && !result && i < answer->trace_count; i++)
        result = dds_write(writer, &answer->traces[i]);
    delivery_of(writers, client, CHANNEL_TRACE, result);
}

enum delivery reply_writers_write(struct reply_writers *writers, const uint8_t client[16],
                                  const struct answer *answer)
{
    enum delivery delivery;
    dds_entity_t writer =
        destinations_writer(writers->destinations, client, answer->exchange, &delivery);
    if (!writer)
        return delivery;
    if (answer->trace_count > 0)
        write_traces(writers, client, answer);
    return delivery_of(writers, client, answer->exchange, answer_write(writer, answer));
}

enum delivery reply_writers_publish(struct reply_writers *writers, const uint8_t client[16],
                                    unsigned channel, const void *sample, unsigned patience)
{
    enum delivery delivery;
    dds_entity_t writer = destinations_writer(writers->destinations, client, channel, &delivery);
    if (!writer)
        return delivery;
    dds_return_t result = dds_write(writer, sample);
    for (unsigned i = 1; result == DDS_RETCODE_TIMEOUT && i < patience; i++)
        result = dds_write(writer, sample);
    return delivery_of(writers, client, channel, result);
}

static void flush_one(void *end, dds_entity_t writer)
{
    double left = *(const double *)end - clock_now();
    if (left > 0.0)
        dds_wait_for_acks(writer, (dds_duration_t)(left * 1e9));
}

void reply_writers_flush(struct reply_writers *writers, double seconds)
{
    double end = clock_now() + seconds;
    destinations_visit(writers->destinations, flush_one, &end);
}

size_t reply_writers_count(struct reply_writers *writers)
{
    return destinations_count(writers->destinations);
}
