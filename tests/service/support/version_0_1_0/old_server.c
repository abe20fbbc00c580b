/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A server on the types of 0.1.0: announces itself and answers every request with the same numbers,
 * of which e = 0.625. It does not know that a request may name a server. Prints "there" and runs
 * until killed.
 *
 * usage: old_server DOMAIN */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

enum { CLIENTS = 16 };

/* Who reads replies in a partition of his own. */
struct client {
    uint8_t id[16];
    dds_entity_t replies;
};

struct old_server {
    dds_entity_t participant, requests, reply_topic;
    size_t count;
    struct client clients[CLIENTS];
};

static dds_entity_t checked(dds_entity_t entity)
{
    REQUIRE(entity > 0, "%s", dds_strretcode(entity));
    return entity;
}

static dds_entity_t topic(const struct old_server *server, const dds_topic_descriptor_t *type,
                          const char *name)
{
    return checked(dds_create_topic(server->participant, type, name, NULL, NULL));
}

/* The writer of his replies. */
static dds_entity_t meet(struct old_server *server, const uint8_t id[16])
{
    char partition[WIRE_REPLIES_SIZE];
    for (size_t i = 0; i < server->count; i++) {
        if (memcmp(server->clients[i].id, id, 16) == 0)
            return server->clients[i].replies;
    }
    REQUIRE(server->count < CLIENTS, "more clients than the test has");
    struct client *client = &server->clients[server->count++];
    memcpy(client->id, id, sizeof client->id);
    wire_partition_of_replies(id, NULL, partition);
    dds_qos_t *inside = dds_create_qos(), *qos = wire_qos_exchange(NULL);
    dds_qset_partition1(inside, partition);
    dds_entity_t publisher = checked(dds_create_publisher(server->participant, inside, NULL));
    client->replies = checked(dds_create_writer(publisher, server->reply_topic, qos, NULL));
    dds_delete_qos(inside);
    dds_delete_qos(qos);
    return client->replies;
}

static void announce(const struct old_server *server)
{
    percuss_v1_ServerStatus status = {.uptime = 100.0, .bodies = 2};
    memset(status.server, 0x5e, sizeof status.server);
    strcpy(status.state, "ready");
    strcpy(status.version, "0.1.0");
    dds_qos_t *qos = wire_qos_announcement(NULL);
    dds_entity_t writer = checked(dds_create_writer(
        server->participant, topic(server, &percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS),
        qos, NULL));
    dds_delete_qos(qos);
    dds_write(writer, &status);
}

static void answer(struct old_server *server, const percuss_v1_Request *request)
{
    percuss_v1_SubImpact sub_impact = {.end = 2e-4, .impulse = 0.03, .peak_force = 250.0};
    percuss_v1_ContactResult contact = {.impulse = 0.03,
                                        .impulse_vector = {0.0, 0.0, 0.03},
                                        .impulse_compression = 0.02,
                                        .restitution = 0.625,
                                        .end_time = 2e-4,
                                        .sub_impact_count = 1};
    percuss_v1_Reply reply = {.sequence = request->sequence, .status = percuss_v1_STATUS_OK};
    memcpy(reply.client, request->client, sizeof reply.client);
    memset(reply.server, 0x5e, sizeof reply.server);
    strcpy(reply.version, "0.1.0");
    dds_entity_t replies = meet(server, request->client);
    /* a ping has the head alone */
    if (request->sequence > 0) {
        contact.sub_impacts._buffer = &sub_impact;
        contact.sub_impacts._length = contact.sub_impacts._maximum = 1;
        reply.contacts._buffer = &contact;
        reply.contacts._length = reply.contacts._maximum = 1;
        reply.complete = true;
        reply.error.restitution_time = 3e-4;
        reply.error.tolerance_met = true;
    }
    dds_write(replies, &reply);
}

int main(int argc, char **argv)
{
    static struct old_server server;
    if (argc != 2) {
        fprintf(stderr, "usage: old_server DOMAIN\n");
        return 2;
    }
    server.participant = checked(wire_participant_create((uint32_t)strtoul(argv[1], NULL, 10)));
    server.reply_topic = topic(&server, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY);
    dds_qos_t *qos = wire_qos_exchange(NULL);
    server.requests = checked(
        dds_create_reader(server.participant,
                          topic(&server, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST), qos, NULL));
    dds_delete_qos(qos);
    announce(&server);
    puts("there");
    fflush(stdout);
    for (;;) {
        void *sample[1] = {NULL};
        dds_sample_info_t info;
        while (dds_take(server.requests, sample, &info, 1, 1) == 1) {
            if (info.valid_data)
                answer(&server, sample[0]);
            dds_return_loan(server.requests, sample, 1);
        }
        dds_sleepfor(DDS_MSECS(1));
    }
}
