/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_size.h"

#include "samples.h"
#include "wire.h"
#include <dds/ddsi/ddsi_serdata.h>

static const double patience = 20.0; /* s */

static dds_entity_t create_reader(dds_entity_t participant, const dds_topic_descriptor_t *type,
                                  const char *name, const char *partition)
{
    dds_qos_t *qos = wire_qos_exchange(partition);
    dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
    dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
    dds_delete_qos(qos);
    return reader;
}

/* The size of the next sample, 0 if there is none. */
static size_t take_size(dds_entity_t reader)
{
    struct ddsi_serdata *sample = NULL;
    dds_sample_info_t info;
    size_t size = 0;
    if (dds_takecdr(reader, &sample, 1, &info, DDS_ANY_STATE) == 1) {
        if (info.valid_data)
            size = ddsi_serdata_size(sample);
        ddsi_serdata_unref(sample);
    }
    return size;
}

static bool ask(struct percuss_client *client, const struct query *query)
{
    double seconds;
    struct percuss_request request;
    struct percuss_reply reply;
    if (!query->b)
        return percuss_ping(client, patience, &seconds) == PERCUSS_RESULT_OK;
    query_fill(query, 0, &request);
    if (percuss_solve(client, &request, patience, &reply) != PERCUSS_RESULT_OK)
        return false;
    bool answered = reply.status == PERCUSS_OK;
    if (!answered)
        fprintf(stderr, "%s: %s\n", query->name, reply.message);
    percuss_reply_free(&reply);
    return answered;
}

bool wire_size_find(uint32_t domain, struct percuss_client *client, const struct query *query,
                    struct wire_size *size)
{
    uint8_t id[16];
    char partition[WIRE_REPLIES_SIZE];
    percuss_client_id(client, id);
    wire_partition_of_replies(id, NULL, partition);
    dds_entity_t participant = wire_participant_create(domain);
    dds_entity_t requests =
        create_reader(participant, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST, NULL);
    dds_entity_t replies =
        create_reader(participant, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY, partition);
    *size = (struct wire_size){0};
    double end = samples_now() + patience;
    /* again until both readers are matched */
    while ((!size->request || !size->reply) && samples_now() < end && ask(client, query)) {
        dds_sleepfor(DDS_MSECS(20));
        size->request = take_size(requests);
        size->reply = take_size(replies);
    }
    dds_delete(participant);
    return size->request && size->reply;
}
