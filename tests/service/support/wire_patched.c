/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Somebody with an identity whose own plugins forbid him nothing (patched_plugins.c): asks, listens
 * to the replies of all clients, and announces itself as a server, for some seconds. Says how many
 * answers it got, and how many replies to others. usage: wire_patched DOMAIN IDENTITY PLUGINS
 * SECONDS */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "peer.h"
#include "wire_loopback.h"
#include "wire_security.h"

static dds_entity_t checked(dds_entity_t entity)
{
    REQUIRE(entity > 0, "%s", dds_strretcode(entity));
    return entity;
}

static dds_entity_t open_participant(uint32_t domain, const char *identity, const char *plugins)
{
    dds_qos_t *qos = dds_create_qos();
    REQUIRE(wire_security_set(identity, qos), "%s: its list is bad", identity);
    dds_qset_prop(qos, "dds.sec.access.library.path", plugins);
    dds_qset_prop(qos, "dds.sec.access.library.init", "patched_access_init");
    dds_qset_prop(qos, "dds.sec.access.library.finalize", "patched_access_finalize");
    dds_qset_prop(qos, "dds.sec.crypto.library.path", plugins);
    dds_qset_prop(qos, "dds.sec.crypto.library.init", "patched_crypto_init");
    dds_qset_prop(qos, "dds.sec.crypto.library.finalize", "patched_crypto_finalize");
    checked(wire_loopback_create(domain, WIRE_SERVER));
    dds_entity_t participant = checked(dds_create_participant(domain, qos, NULL));
    dds_delete_qos(qos);
    return participant;
}

static dds_entity_t open_reader(dds_entity_t participant, dds_entity_t topic, const char *partition)
{
    dds_qos_t *qos = wire_qos_exchange(partition);
    dds_entity_t reader = checked(dds_create_reader(participant, topic, qos, NULL));
    dds_delete_qos(qos);
    return reader;
}

/* The number of replies that have come, to that client or to others. */
static unsigned take_all(dds_entity_t reader, const uint8_t client[16], bool to_others)
{
    unsigned count = 0;
    void *sample[1] = {NULL};
    dds_sample_info_t info;
    while (dds_take(reader, sample, &info, 1, 1) == 1) {
        const percuss_v1_Reply *reply = sample[0];
        count += info.valid_data && (memcmp(reply->client, client, 16) != 0) == to_others;
        dds_return_loan(reader, sample, 1);
    }
    return count;
}

int main(int argc, char **argv)
{
    REQUIRE(argc == 5, "usage: wire_patched DOMAIN IDENTITY PLUGINS SECONDS");
    dds_entity_t participant =
        open_participant((uint32_t)strtoul(argv[1], NULL, 10), argv[2], argv[3]);
    dds_entity_t requests =
        checked(wire_topic_create(participant, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST));
    dds_entity_t replies =
        checked(wire_topic_create(participant, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY));
    dds_entity_t states = checked(
        wire_topic_create(participant, &percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS));
    dds_qos_t *to = wire_qos_exchange(NULL), *announces = wire_qos_announcement(NULL);
    dds_entity_t asks = checked(dds_create_writer(participant, requests, to, NULL));
    dds_entity_t announcer = checked(dds_create_writer(participant, states, announces, NULL));
    dds_delete_qos(to);
    dds_delete_qos(announces);
    /* its own replies, and those of all */
    static struct scene scene;
    char own[WIRE_REPLIES_SIZE];
    scene_fill(&scene, 0, 0.3);
    REQUIRE(getrandom(scene.request.client, sizeof scene.request.client, 0) > 0, "no random");
    wire_partition_of_replies(scene.request.client, NULL, own);
    dds_entity_t mine = open_reader(participant, replies, own);
    dds_entity_t all = open_reader(participant, replies, "c_*");
    percuss_v1_ServerStatus status = {.bodies = 7777};
    memset(status.server, 0xee, sizeof status.server);
    unsigned answers = 0, overheard = 0;
    for (double end = peer_now() + strtod(argv[4], NULL); peer_now() < end;) {
        scene.request.sequence++;
        dds_write(asks, &scene.request);
        dds_write(announcer, &status);
        dds_sleepfor(DDS_MSECS(50));
        answers += take_all(mine, scene.request.client, false);
        overheard += take_all(all, scene.request.client, true);
    }
    printf("%u answers, %u replies to others\n", answers, overheard);
    dds_delete(dds_get_parent(participant));
    return 0;
}
