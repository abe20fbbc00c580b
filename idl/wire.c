/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire.h"

#include <stdio.h>
#include <stdlib.h>

/* Loopback has no multicast, so peers are addressed by port: one index per process, at most 100.
 * A lease of 2 s lets the daemon notice a killed client soon. The same stands in
 * config/cyclonedds.xml for people who want to start from it. */
static const char *const builtin_configuration =
    "<CycloneDDS><Domain Id=\"any\">"
    "<General>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast>"
    "</General>"
    "<Discovery>"
    "<ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>100</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers>"
    "<LeaseDuration>2 s</LeaseDuration>"
    "</Discovery>"
    "</Domain></CycloneDDS>";

dds_entity_t wire_participant_create(uint32_t domain)
{
    const char *uri = getenv("CYCLONEDDS_URI");
    if (!uri || !*uri) {
        dds_entity_t created = dds_create_domain(domain, builtin_configuration);
        /* the domain of an earlier participant of this process serves as well */
        if (created < 0 && created != DDS_RETCODE_PRECONDITION_NOT_MET)
            return created;
    }
    return dds_create_participant(domain, NULL, NULL);
}

dds_qos_t *wire_qos_exchange(const char *partition)
{
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, WIRE_WINDOW);
    if (partition)
        dds_qset_partition1(qos, partition);
    return qos;
}

dds_qos_t *wire_qos_announcement(void)
{
    dds_qos_t *qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    return qos;
}

void wire_partition_name(const uint8_t client[16], char name[WIRE_PARTITION_SIZE])
{
    name[0] = 'c';
    name[1] = '_';
    for (int i = 0; i < 16; ++i)
        snprintf(name + 2 + 2 * i, 3, "%02x", client[i]);
}
