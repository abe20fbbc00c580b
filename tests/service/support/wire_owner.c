/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Somebody asks with the id of a client that is there: he is not answered, and the client does not
 * notice. Once the client has gone, the id is whose it is then. usage: wire_owner DOMAIN */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

static dds_entity_t checked(dds_entity_t entity)
{
    REQUIRE(entity > 0, "%s", dds_strretcode(entity));
    return entity;
}

/* A writer of requests in a participant of its own, which the server has found. */
static dds_entity_t open_writer(uint32_t domain)
{
    dds_publication_matched_status_t matched = {0};
    dds_entity_t participant = checked(wire_participant_create(domain));
    dds_entity_t topic =
        checked(wire_topic_create(participant, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST));
    dds_qos_t *qos = wire_qos_exchange(NULL);
    dds_entity_t writer = checked(dds_create_writer(participant, topic, qos, NULL));
    dds_delete_qos(qos);
    double end = peer_now() + 20.0;
    while (matched.current_count == 0) {
        REQUIRE(peer_now() < end, "no server");
        dds_sleepfor(DDS_MSECS(2));
        dds_get_publication_matched_status(writer, &matched);
    }
    return writer;
}

/* The client's next question has its own answer. */
static void ask(struct peer *peer, struct scene *scene, uint64_t sequence)
{
    scene_fill(scene, sequence, 0.3);
    peer_send(peer, &scene->request);
    const percuss_v1_Reply *reply = peer_receive(peer, PEER_SINGLE, 20.0);
    REQUIRE(reply->sequence == sequence && reply->status <= 1, "sequence %llu, status %u: %s",
            (unsigned long long)reply->sequence, reply->status, reply->message);
    peer_return(peer, PEER_SINGLE, reply);
}

int main(int argc, char **argv)
{
    REQUIRE(argc == 2, "usage: wire_owner DOMAIN");
    uint32_t domain = (uint32_t)strtoul(argv[1], NULL, 10);
    static struct scene scene;
    struct peer client, heir;
    peer_open(&client, domain);
    ask(&client, &scene, 1);
    /* a stranger uses up its numbers, as he thinks, and pings */
    dds_entity_t writer = open_writer(domain);
    for (uint64_t sequence = 0; sequence < 10; sequence++) {
        scene_fill(&scene, sequence, 0.2);
        memcpy(scene.request.client, client.client, sizeof client.client);
        REQUIRE(dds_write(writer, &scene.request) == DDS_RETCODE_OK, "cannot be written");
    }
    /* longer than any of these solves takes */
    REQUIRE(!peer_hears(&client, PEER_SINGLE, 2.0), "the client was told of it");
    for (uint64_t sequence = 2; sequence < 10; sequence++)
        ask(&client, &scene, sequence);
    /* the id is the next one's that reads its replies */
    heir = client;
    peer_close(&client);
    peer_open_as(&heir, domain);
    ask(&heir, &scene, 11);
    peer_close(&heir);
    puts("ok");
    return 0;
}
