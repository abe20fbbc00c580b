/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/dents_topic.h"

#include <string.h>

#include "exchange/text.h"

enum { TAKEN_AT_ONCE = 8 };

bool dents_topic_open(struct dents_topic *topic, dds_entity_t participant, const char *partition,
                      const uint8_t server[16], struct fault *fault)
{
    memcpy(topic->server, server, sizeof topic->server);
    dds_entity_t name = wire_topic_create(participant, &percuss_v1_Dents_desc, WIRE_TOPIC_DENTS);
    dds_qos_t *announces = wire_qos_announcement(partition), *hears = wire_qos_exchange(partition);
    dds_qset_ignorelocal(hears, DDS_IGNORELOCAL_PARTICIPANT);
    topic->writer = dds_create_writer(participant, name, announces, NULL);
    topic->reader = dds_create_reader(participant, name, hears, NULL);
    dds_delete_qos(announces);
    dds_delete_qos(hears);
    if (topic->writer > 0 && topic->reader > 0 &&
        dds_set_status_mask(topic->reader, DDS_DATA_AVAILABLE_STATUS) == DDS_RETCODE_OK)
        return true;
    fault_set(fault, PERCUSS_INTERNAL, "DDS: " WIRE_TOPIC_DENTS ": %s",
              dds_strretcode(topic->reader < 0 ? topic->reader : topic->writer));
    return false;
}

static void fill_patches(percuss_v1_Dent *patches, const struct body_state *state)
{
    const struct dent *dents = body_state_dents(state);
    for (size_t i = 0; i < state->dents; i++) {
        memcpy(patches[i].point, dents[i].point, sizeof patches[i].point);
        patches[i].size = dents[i].size;
        patches[i].max_indentation = dents[i].history.max_indentation;
        patches[i].max_force = dents[i].history.max_force;
        patches[i].residual_indentation = dents[i].history.dent;
        patches[i].contact_radius = dents[i].history.contact_radius;
    }
}

void dents_topic_announce(const struct dents_topic *topic, const struct dents_notice *notice)
{
    percuss_v1_Dent patches[BODY_STATE_MAX_DENTS];
    percuss_v1_Dents wire = {.impacts = notice->impacts};
    uint32_t count = notice->state ? (uint32_t)notice->state->dents : 0;
    COPY_TEXT(wire.specimen, notice->specimen);
    COPY_TEXT(wire.body, notice->body);
    memcpy(wire.server, topic->server, sizeof wire.server);
    if (count)
        fill_patches(patches, notice->state);
    wire.patches._buffer = patches;
    wire.patches._length = wire.patches._maximum = count;
    dds_write(topic->writer, &wire);
}

void dents_topic_withdraw(const struct dents_topic *topic, const char *specimen)
{
    percuss_v1_Dents wire = {0};
    COPY_TEXT(wire.specimen, specimen);
    memcpy(wire.server, topic->server, sizeof wire.server);
    dds_dispose(topic->writer, &wire);
}

void dents_topic_take(const struct dents_topic *topic,
                      void (*clear)(void *context, const char *specimen), void *context)
{
    void *samples[TAKEN_AT_ONCE] = {NULL};
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t count;
    while ((count = dds_take(topic->reader, samples, infos, TAKEN_AT_ONCE, TAKEN_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < count; i++) {
            const percuss_v1_Dents *wire = samples[i];
            if (infos[i].valid_data && wire->clear &&
                memcmp(wire->server, topic->server, sizeof wire->server) == 0)
                clear(context, wire->specimen);
        }
        dds_return_loan(topic->reader, samples, count);
    }
}
