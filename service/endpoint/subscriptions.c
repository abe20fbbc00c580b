/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/subscriptions.h"

#include <string.h>

#include "exchange/key_map.h"

enum { TAKEN_AT_ONCE = 32 };

dds_entity_t subscriptions_open(dds_entity_t participant, struct fault *fault)
{
    dds_entity_t reader =
        dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, NULL, NULL);
    if (reader > 0)
        return reader;
    fault_set(fault, PERCUSS_INTERNAL, "reader of subscriptions: %s", dds_strretcode(reader));
    return 0;
}

/* The client, of those who ask in `partition`, whose replies this partition is for. */
static bool parse_name(const char *name, const char *partition, uint8_t client[16])
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
static bool find_client(const dds_qos_t *qos, const char *partition, uint8_t client[16])
{
    uint32_t count = 0;
    char **names = NULL;
    bool found = false;
    if (!dds_qget_partition(qos, &count, &names))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        found = found || parse_name(names[i], partition, client);
        dds_free(names[i]);
    }
    dds_free(names);
    return found;
}

void subscriptions_take(dds_entity_t reader, const char *partition,
                        void (*visit)(void *context, const struct subscription *subscription),
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
                infos[i].valid_data && find_client(endpoint->qos, partition, subscription.client);
            visit(context, &subscription);
        }
        dds_return_loan(reader, samples, count);
    }
}
