/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/servers.h"

/* Always the same room: Cyclone DDS 0.10.2 fills that of the loan of an earlier read. */
enum { ROOM = 64 };

dds_entity_t servers_open(dds_entity_t participant, const char *partition, struct fault *fault)
{
    dds_qos_t *qos = wire_qos_announcement(partition);
    dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
    dds_entity_t reader =
        wire_topic_create(participant, &percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS);
    if (reader > 0)
        reader = dds_create_reader(participant, reader, qos, NULL);
    dds_delete_qos(qos);
    if (reader > 0)
        return reader;
    fault_set(fault, PERCUSS_INTERNAL, "DDS: reader of " WIRE_TOPIC_SERVER_STATUS ": %s",
              dds_strretcode(reader));
    return 0;
}

void servers_visit(dds_entity_t reader, server_visitor *visitor, void *context)
{
    void *samples[ROOM] = {NULL};
    dds_sample_info_t infos[ROOM];
    dds_return_t count =
        dds_read_mask(reader, samples, infos, ROOM, ROOM,
                      DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
    for (dds_return_t i = 0; i < count; i++) {
        if (infos[i].valid_data)
            visitor(context, samples[i]);
    }
    if (count > 0)
        dds_return_loan(reader, samples, count);
}
