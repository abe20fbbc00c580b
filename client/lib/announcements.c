/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "announcements.h"

#include <stdlib.h>
#include <string.h>

#include "error.h"
#include "failure.h"
#include "receive.h"

enum { FIRST_ROOM = 64 };

void announcements_release(struct announcements *all)
{
    if (all->count > 0)
        dds_return_loan(all->reader, all->samples, all->count);
    free(all->samples);
    free(all->infos);
    *all = (struct announcements){0};
}

/* Reads into room for `room` samples; PENDING: there may be more. */
static enum percuss_result read_into(dds_entity_t reader, int room, struct announcements *all)
{
    *all = (struct announcements){.reader = reader};
    all->samples = calloc((size_t)room, sizeof *all->samples);
    all->infos = calloc((size_t)room, sizeof *all->infos);
    if (!all->samples || !all->infos) {
        announcements_release(all);
        return error_set(PERCUSS_RESULT_NO_MEMORY, "%d announcements", room);
    }
    all->count =
        dds_read_mask(reader, all->samples, all->infos, (size_t)room, (uint32_t)room,
                      DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
    if (all->count < 0) {
        int code = all->count;
        announcements_release(all);
        return failure_dds("reading announcements", code);
    }
    return all->count == room ? PERCUSS_RESULT_PENDING : PERCUSS_RESULT_OK;
}

/* Cyclone DDS 0.10.2 keeps the loan of an earlier read and fills all of it: a later read on the
 * same reader must never offer less room. So the room only grows, and one thread reads at a time.
 */
enum percuss_result announcements_read(struct percuss_client *client, dds_entity_t reader,
                                       struct announcements *all)
{
    pthread_mutex_lock(&client->lock);
    if (client->announcement_room == 0)
        client->announcement_room = FIRST_ROOM;
    enum percuss_result result = read_into(reader, client->announcement_room, all);
    while (result == PERCUSS_RESULT_PENDING) {
        announcements_release(all);
        client->announcement_room *= 2;
        result = read_into(reader, client->announcement_room, all);
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}

enum percuss_result announcements_open(struct percuss_client *client, dds_entity_t *slot,
                                       const dds_topic_descriptor_t *descriptor, const char *topic)
{
    enum percuss_result result = client_check_identity(client);
    pthread_mutex_lock(&client->lock);
    if (result == PERCUSS_RESULT_OK && !*slot) {
        dds_entity_t reader = client_reader_create(client, descriptor, topic,
                                                   wire_qos_announcement(client->partition));
        if (reader < 0)
            result = failure_dds(topic, reader);
        else
            *slot = reader;
    }
    pthread_mutex_unlock(&client->lock);
    return result;
}

bool announcements_server(struct percuss_client *client, uint8_t server[16])
{
    pthread_mutex_lock(&client->lock);
    if (client->connected)
        receive_note_loss(client);
    bool connected = client->connected && !client->lost;
    memcpy(server, client->server.id, 16);
    pthread_mutex_unlock(&client->lock);
    return connected;
}
