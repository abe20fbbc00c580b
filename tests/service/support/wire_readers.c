/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A stranger who reads the replies of clients that do not exist: as many as are asked for, all at
 * once, by one participant. Stays for some seconds.
 *
 * usage: wire_readers DOMAIN READERS SECONDS */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

int main(int argc, char **argv)
{
    REQUIRE(argc == 4, "usage: wire_readers DOMAIN READERS SECONDS");
    dds_entity_t participant = wire_participant_create((uint32_t)strtoul(argv[1], NULL, 10));
    REQUIRE(participant > 0, "participant: %s", wire_participant_problem(participant));
    dds_entity_t topic = wire_topic_create(participant, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY);
    uint32_t count = (uint32_t)strtoul(argv[2], NULL, 10);
    double start = peer_now();
    for (uint32_t i = 0; i < count; i++) {
        char partition[WIRE_REPLIES_SIZE];
        uint8_t client[16] = {0xff};
        memcpy(client + 8, &i, sizeof i);
        wire_partition_of_replies(client, NULL, partition);
        dds_qos_t *qos = wire_qos_exchange(partition);
        REQUIRE(dds_create_reader(participant, topic, qos, NULL) > 0, "reader %u", i);
        dds_delete_qos(qos);
    }
    printf("%u readers in %.2f s\n", count, peer_now() - start);
    fflush(stdout);
    dds_sleepfor((dds_duration_t)(1e9 * strtod(argv[3], NULL)));
    dds_delete(participant);
    return EXIT_SUCCESS;
}
