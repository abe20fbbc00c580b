/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "peer.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>

static const double patience = 20.0; /* s */

static const struct {
    const char *request, *reply;
    const dds_topic_descriptor_t *request_type, *reply_type;
} topics[PEER_TOPICS] = {
    {WIRE_TOPIC_REQUEST, WIRE_TOPIC_REPLY, &percuss_v1_Request_desc, &percuss_v1_Reply_desc},
    {WIRE_TOPIC_BATCH_REQUEST, WIRE_TOPIC_BATCH_REPLY, &percuss_v1_BatchRequest_desc,
     &percuss_v1_BatchReply_desc},
    {WIRE_TOPIC_ENSEMBLE_REQUEST, WIRE_TOPIC_ENSEMBLE_REPLY, &percuss_v1_EnsembleRequest_desc,
     &percuss_v1_EnsembleReply_desc},
};

_Noreturn void peer_fail(const char *file, int line, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fprintf(stderr, "%s:%d: ", file, line);
    vfprintf(stderr, format, args);
    fputc('\n', stderr);
    va_end(args);
    exit(EXIT_FAILURE);
}

double peer_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static dds_entity_t checked(dds_entity_t entity)
{
    REQUIRE(entity > 0, "%s", dds_strretcode(entity));
    return entity;
}

static void create_entities(struct peer *peer)
{
    char partition[WIRE_REPLIES_SIZE];
    wire_partition_of_replies(peer->client, NULL, partition);
    dds_qos_t *to = wire_qos_exchange(NULL), *from = wire_qos_exchange(partition);
    for (int i = 0; i < PEER_TOPICS; i++) {
        dds_entity_t request = checked(dds_create_topic(peer->participant, topics[i].request_type,
                                                        topics[i].request, NULL, NULL));
        dds_entity_t reply = checked(
            dds_create_topic(peer->participant, topics[i].reply_type, topics[i].reply, NULL, NULL));
        peer->readers[i] = checked(dds_create_reader(peer->participant, reply, from, NULL));
        peer->writers[i] = checked(dds_create_writer(peer->participant, request, to, NULL));
        peer->waitsets[i] = checked(dds_create_waitset(peer->participant));
        dds_entity_t condition = checked(dds_create_readcondition(peer->readers[i], DDS_ANY_STATE));
        dds_waitset_attach(peer->waitsets[i], condition, 0);
    }
    dds_delete_qos(to);
    dds_delete_qos(from);
}

static bool is_matched(const struct peer *peer)
{
    for (int i = 0; i < PEER_TOPICS; i++) {
        dds_instance_handle_t other;
        if (dds_get_matched_subscriptions(peer->writers[i], &other, 1) < 1 ||
            dds_get_matched_publications(peer->readers[i], &other, 1) < 1)
            return false;
    }
    return true;
}

void peer_open(struct peer *peer, uint32_t domain)
{
    REQUIRE(getrandom(peer->client, sizeof peer->client, 0) > 0, "no random numbers");
    peer_open_as(peer, domain);
}

void peer_open_as(struct peer *peer, uint32_t domain)
{
    peer->participant = checked(wire_participant_create(domain));
    create_entities(peer);
    double end = peer_now() + patience;
    while (!is_matched(peer)) {
        REQUIRE(peer_now() < end, "no server in domain %u", domain);
        dds_sleepfor(DDS_MSECS(2));
    }
    percuss_v1_Request ping = {.sequence = 0};
    do {
        REQUIRE(peer_now() < end, "no answer to a ping");
        peer_send(peer, &ping);
    } while (!peer_hears(peer, PEER_SINGLE, 0.05));
    /* replies to further pings */
    while (peer_hears(peer, PEER_SINGLE, 0.02))
        continue;
}

void peer_close(struct peer *peer)
{
    dds_delete(peer->participant);
}

static void send(struct peer *peer, enum peer_topic topic, const void *sample)
{
    dds_return_t result = dds_write(peer->writers[topic], sample);
    REQUIRE(result == DDS_RETCODE_OK, "write: %s", dds_strretcode(result));
}

void peer_send(struct peer *peer, percuss_v1_Request *request)
{
    memcpy(request->client, peer->client, sizeof request->client);
    send(peer, PEER_SINGLE, request);
}

void peer_send_batch(struct peer *peer, percuss_v1_BatchRequest *batch)
{
    memcpy(batch->client, peer->client, sizeof batch->client);
    send(peer, PEER_BATCH, batch);
}

void peer_send_ensemble(struct peer *peer, percuss_v1_EnsembleRequest *ensemble)
{
    memcpy(ensemble->client, peer->client, sizeof ensemble->client);
    send(peer, PEER_ENSEMBLE, ensemble);
}

/* A sample within `seconds`, or NULL. */
static void *take_within(struct peer *peer, enum peer_topic topic, double seconds)
{
    double end = peer_now() + seconds;
    for (;;) {
        dds_sample_info_t info;
        void *sample[1] = {NULL};
        dds_return_t count = dds_take(peer->readers[topic], sample, &info, 1, 1);
        if (count == 1 && info.valid_data)
            return sample[0];
        if (count == 1)
            dds_return_loan(peer->readers[topic], sample, 1);
        double left = end - peer_now();
        if (left <= 0.0)
            return NULL;
        if (count < 1)
            dds_waitset_wait(peer->waitsets[topic], NULL, 0, (dds_duration_t)(left * 1e9) + 1);
    }
}

const void *peer_receive(struct peer *peer, enum peer_topic topic, double seconds)
{
    void *sample = take_within(peer, topic, seconds);
    REQUIRE(sample, "no reply within %g s", seconds);
    return sample;
}

void peer_return(struct peer *peer, enum peer_topic topic, const void *reply)
{
    void *sample[1] = {(void *)reply};
    dds_return_loan(peer->readers[topic], sample, 1);
}

bool peer_hears(struct peer *peer, enum peer_topic topic, double seconds)
{
    void *sample = take_within(peer, topic, seconds);
    if (sample)
        peer_return(peer, topic, sample);
    return sample != NULL;
}

static void fill_body(percuss_v1_BodyMotion *body, const char *id, double z, double speed)
{
    *body = (percuss_v1_BodyMotion){
        .position = {0, 0, z}, .orientation = {1, 0, 0, 0}, .velocity = {0, 0, -speed}};
    snprintf(body->id, sizeof body->id, "%s", id);
}

void scene_fill(struct scene *scene, uint64_t sequence, double speed)
{
    fill_body(&scene->bodies[0], "steel-sphere", 0.025, speed);
    fill_body(&scene->bodies[1], "al-beam", 0.0, 0.0);
    scene->contacts[0] =
        (percuss_v1_Contact){.a = 0, .b = 1, .point = {0, 0, 0.010}, .normal = {0, 0, 1}};
    scene->request = (percuss_v1_Request){
        .sequence = sequence,
        .bodies = {._buffer = scene->bodies, ._length = 2, ._maximum = 64},
        .contacts = {._buffer = scene->contacts, ._length = 1, ._maximum = 64},
        .delassus = {._buffer = scene->delassus, ._length = 0, ._maximum = 4096},
    };
}
