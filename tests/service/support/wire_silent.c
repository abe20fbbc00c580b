/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A server that is there and answers nobody, as one whose reading thread is held up: it reads
 * requests and has a writer of replies for some other client. Prints "there" and runs until killed.
 *
 * usage: wire_silent DOMAIN announced|anonymous|unreliable
 *   announced   it has announced itself, as id 5e5e5e5e...
 *   anonymous   it has not
 *   unreliable  nor are its replies reliable, as clients want them */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "peer.h"

static dds_entity_t checked(dds_entity_t entity)
{
    REQUIRE(entity > 0, "%s", dds_strretcode(entity));
    return entity;
}

static void read_requests(dds_entity_t participant)
{
    dds_qos_t *qos = wire_qos_exchange(NULL);
    dds_entity_t topic = checked(
        dds_create_topic(participant, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST, NULL, NULL));
    checked(dds_create_reader(participant, topic, qos, NULL));
    dds_delete_qos(qos);
}

static void write_replies(dds_entity_t participant, bool reliable)
{
    static const uint8_t somebody[16] = {1};
    char partition[WIRE_REPLIES_SIZE];
    wire_partition_of_replies(somebody, NULL, partition);
    dds_qos_t *qos = wire_qos_exchange(partition);
    if (!reliable)
        dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_entity_t topic = checked(
        dds_create_topic(participant, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY, NULL, NULL));
    checked(dds_create_writer(participant, topic, qos, NULL));
    dds_delete_qos(qos);
}

static void announce(dds_entity_t participant)
{
    percuss_v1_ServerStatus status = {.process = (uint32_t)getpid(), .host = "here"};
    memset(status.server, 0x5e, sizeof status.server);
    strcpy(status.state, "ready");
    dds_qos_t *qos = wire_qos_announcement(NULL);
    dds_entity_t topic = checked(dds_create_topic(participant, &percuss_v1_ServerStatus_desc,
                                                  WIRE_TOPIC_SERVER_STATUS, NULL, NULL));
    dds_entity_t writer = checked(dds_create_writer(participant, topic, qos, NULL));
    dds_delete_qos(qos);
    dds_write(writer, &status);
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: wire_silent DOMAIN announced|anonymous|unreliable\n");
        return 2;
    }
    dds_entity_t participant =
        checked(wire_participant_create((uint32_t)strtoul(argv[1], NULL, 10)));
    read_requests(participant);
    write_replies(participant, strcmp(argv[2], "unreliable") != 0);
    if (strcmp(argv[2], "announced") == 0)
        announce(participant);
    puts("there");
    fflush(stdout);
    for (;;)
        pause();
}
