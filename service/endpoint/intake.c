/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/intake.h"

#include <dds/ddsi/ddsi_serdata.h>
#include <string.h>

/* Samples are taken all before any is looked at, so that those of many writers can take turns;
 * looked at are a few before the next look at who has come. */
enum { TAKEN_AT_ONCE = 32, TAKEN_BEFORE = 32 * TAKEN_AT_ONCE, SERVED_AT_ONCE = 16 };

static const struct {
    const char *topic;
    const dds_topic_descriptor_t *type;
} requests[EXCHANGE_COUNT] = {
    [EXCHANGE_SINGLE] = {WIRE_TOPIC_REQUEST, &percuss_v1_Request_desc},
    [EXCHANGE_BATCH] = {WIRE_TOPIC_BATCH_REQUEST, &percuss_v1_BatchRequest_desc},
    [EXCHANGE_ENSEMBLE] = {WIRE_TOPIC_ENSEMBLE_REQUEST, &percuss_v1_EnsembleRequest_desc},
};

static void drop(void *taken)
{
    ddsi_serdata_unref(taken);
}

bool intake_open(struct intake *intake, enum exchange exchange, dds_entity_t participant,
                 const char *partition, struct fault *fault)
{
    const dds_topic_descriptor_t *type = requests[exchange].type;
    *intake = (struct intake){.exchange = exchange,
                              .sample = dds_alloc(type->m_size),
                              .inbox = inbox_create(WIRE_WINDOW, drop)};
    if (!intake->inbox) {
        fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        return false;
    }
    dds_entity_t topic = wire_topic_create(participant, type, requests[exchange].topic);
    dds_qos_t *qos = wire_qos_exchange(partition);
    intake->reader = topic > 0 ? dds_create_reader(participant, topic, qos, NULL) : topic;
    dds_delete_qos(qos);
    if (intake->reader < 0)
        fault_set(fault, PERCUSS_INTERNAL, "DDS: reader of %s: %s", requests[exchange].topic,
                  dds_strretcode(intake->reader));
    return intake->reader > 0;
}

void intake_close(struct intake *intake)
{
    inbox_free(intake->inbox);
    if (intake->sample)
        dds_sample_free(intake->sample, requests[intake->exchange].type, DDS_FREE_ALL);
}

/* Requests wake by the status of their reader. A read condition would do so while DDS still holds
 * the reader's lock, so that taking them costs another sleep, some 8 us. The status tells of new
 * samples only: whoever is woken takes until none is left. */
bool intake_attach(const struct intake *intake, dds_entity_t waitset)
{
    return dds_set_status_mask(intake->reader, DDS_DATA_AVAILABLE_STATUS) == DDS_RETCODE_OK &&
           dds_waitset_attach(waitset, intake->reader, intake->exchange) == DDS_RETCODE_OK;
}

/* The server that the sample at hand names, and the client whose id it bears. */
static const uint8_t *addressee(const struct intake *intake, const uint8_t **client)
{
    if (intake->exchange == EXCHANGE_BATCH) {
        const percuss_v1_BatchRequest *batch = intake->sample;
        *client = batch->client;
        return batch->server;
    }
    if (intake->exchange == EXCHANGE_ENSEMBLE) {
        const percuss_v1_EnsembleRequest *ensemble = intake->sample;
        *client = ensemble->client;
        return ensemble->server;
    }
    const percuss_v1_Request *request = intake->sample;
    *client = request->client;
    return request->server;
}

/* Whether the sample at hand is for this server, or any, and its client's own. A stranger gets no
 * reply: it would go to the client. */
static bool is_due(struct intake *intake, const struct intake_desk *desk,
                   dds_instance_handle_t writer)
{
    static const uint8_t anybody[16];
    const uint8_t *client, *server = addressee(intake, &client);
    if (memcmp(server, anybody, sizeof anybody) != 0 &&
        memcmp(server, desk->server, sizeof anybody) != 0)
        return false;
    bool own = owners_allow_writer(desk->owners, client, intake->reader, writer);
    if (!own)
        atomic_fetch_add(desk->strange, 1);
    return own;
}

static void handle(const struct intake *intake, const struct endpoint_handler *handler, bool alone)
{
    if (intake->exchange == EXCHANGE_SINGLE)
        handler->single(handler->context, intake->sample, alone);
    else if (intake->exchange == EXCHANGE_BATCH)
        handler->batch(handler->context, intake->sample);
    else
        handler->ensemble(handler->context, intake->sample);
}

/* Decodes and hands on what was taken, if it is due here, and lets go of it. */
static void serve(struct intake *intake, const struct intake_desk *desk, struct ddsi_serdata *taken,
                  dds_instance_handle_t writer, bool alone)
{
    if (ddsi_serdata_to_sample(taken, intake->sample, NULL, NULL) && is_due(intake, desk, writer))
        handle(intake, desk->handler, alone);
    ddsi_serdata_unref(taken);
}

bool intake_take(struct intake *intake, const struct intake_desk *desk)
{
    struct ddsi_serdata *taken[TAKEN_AT_ONCE];
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t count = TAKEN_AT_ONCE;
    for (int all = 0; count == TAKEN_AT_ONCE && all < TAKEN_BEFORE; all += TAKEN_AT_ONCE) {
        count = dds_takecdr(intake->reader, taken, TAKEN_AT_ONCE, infos, DDS_ANY_STATE);
        bool alone = count == 1 && inbox_is_empty(intake->inbox);
        /* samples without data only tell that a client's writer has gone */
        for (dds_return_t i = 0; i < count; i++) {
            if (!infos[i].valid_data)
                ddsi_serdata_unref(taken[i]);
            else if (alone)
                serve(intake, desk, taken[i], infos[i].publication_handle, true);
            else
                inbox_put(intake->inbox, infos[i].publication_handle, taken[i]);
        }
    }
    return count == TAKEN_AT_ONCE;
}

bool intake_serve(struct intake *intake, const struct intake_desk *desk)
{
    for (int i = 0; i < SERVED_AT_ONCE && !inbox_is_empty(intake->inbox); i++) {
        uint64_t writer;
        struct ddsi_serdata *taken = inbox_take(intake->inbox, &writer);
        serve(intake, desk, taken, writer, false);
    }
    return !inbox_is_empty(intake->inbox);
}
