/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Another server, as clients may find it beside the one they are to stay with; id 5e5e5e5e...
 * Prints "there" and runs until killed.
 *
 * usage: wire_foreign DOMAIN late|loud
 *   late  up for longer than any, but says so only after LATE answers to one client; it answers
 * pings and nothing else loud  answers no ping, but writes parts of an ensemble and of a trace, as
 * a daemon that does not know that the request was to another one, all the time */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

/* One every 5 ms: after some 0.08 s, more than a client waits where it knows of nobody else. */
enum { LATE = 16, COLUMNS = 8 };

struct foreign {
    bool loud, announced;
    dds_entity_t participant, requests, ensembles;
    uint8_t client[16]; /* the latest */
    int pings;
    uint64_t sequence; /* of its latest request */
    dds_entity_t replies, progress, samples, trace;
};

static dds_entity_t checked(dds_entity_t entity)
{
    REQUIRE(entity > 0, "%s", dds_strretcode(entity));
    return entity;
}

static dds_entity_t topic(const struct foreign *foreign, const dds_topic_descriptor_t *type,
                          const char *name)
{
    return checked(dds_create_topic(foreign->participant, type, name, NULL, NULL));
}

static dds_entity_t reader(const struct foreign *foreign, const dds_topic_descriptor_t *type,
                           const char *name)
{
    dds_qos_t *qos = wire_qos_exchange(NULL);
    dds_entity_t created =
        checked(dds_create_reader(foreign->participant, topic(foreign, type, name), qos, NULL));
    dds_delete_qos(qos);
    return created;
}

static dds_entity_t writer(const struct foreign *foreign, const dds_topic_descriptor_t *type,
                           const char *name)
{
    char partition[WIRE_REPLIES_SIZE];
    wire_partition_of_replies(foreign->client, NULL, partition);
    dds_qos_t *qos = wire_qos_exchange(partition);
    dds_entity_t created =
        checked(dds_create_writer(foreign->participant, topic(foreign, type, name), qos, NULL));
    dds_delete_qos(qos);
    return created;
}

static void meet(struct foreign *foreign, const uint8_t client[16])
{
    dds_entity_t before[] = {foreign->replies, foreign->progress, foreign->samples, foreign->trace};
    for (size_t i = 0; i < sizeof before / sizeof before[0]; i++)
        if (before[i] > 0)
            dds_delete(before[i]);
    memcpy(foreign->client, client, sizeof foreign->client);
    foreign->pings = 0;
    foreign->replies = writer(foreign, &percuss_v1_Reply_desc, WIRE_TOPIC_REPLY);
    foreign->progress =
        writer(foreign, &percuss_v1_EnsembleProgress_desc, WIRE_TOPIC_ENSEMBLE_PROGRESS);
    foreign->samples =
        writer(foreign, &percuss_v1_EnsembleSamples_desc, WIRE_TOPIC_ENSEMBLE_SAMPLES);
    foreign->trace = writer(foreign, &percuss_v1_Trace_desc, WIRE_TOPIC_TRACE);
}

static void announce(struct foreign *foreign)
{
    percuss_v1_ServerStatus status = {.uptime = 1e6, .host = "here", .state = "ready"};
    memset(status.server, 0x5e, sizeof status.server);
    dds_qos_t *qos = wire_qos_announcement(NULL);
    dds_entity_t announcements = checked(dds_create_writer(
        foreign->participant,
        topic(foreign, &percuss_v1_ServerStatus_desc, WIRE_TOPIC_SERVER_STATUS), qos, NULL));
    dds_delete_qos(qos);
    dds_write(announcements, &status);
    foreign->announced = true;
}

static void answer_ping(struct foreign *foreign)
{
    percuss_v1_Reply reply = {0};
    memcpy(reply.client, foreign->client, sizeof reply.client);
    memset(reply.server, 0x5e, sizeof reply.server);
    /* what nobody hears yet is no answer, and the client goes on counting time from the first one
     */
    dds_instance_handle_t hearer;
    if (dds_get_matched_subscriptions(foreign->replies, &hearer, 1) < 1)
        return;
    dds_write(foreign->replies, &reply);
    if (++foreign->pings == LATE && !foreign->announced)
        announce(foreign);
}

/* Takes a request of either kind; both begin with the client and the sequence. */
static bool take(struct foreign *foreign, dds_entity_t from)
{
    void *sample[1] = {NULL};
    dds_sample_info_t info;
    if (dds_take(from, sample, &info, 1, 1) != 1)
        return false;
    const percuss_v1_Request *single = sample[0];
    const percuss_v1_EnsembleRequest *ensemble = sample[0];
    if (info.valid_data) {
        bool is_single = from == foreign->requests;
        const uint8_t *client = is_single ? single->client : ensemble->client;
        if (foreign->replies == 0 || memcmp(client, foreign->client, sizeof foreign->client))
            meet(foreign, client);
        foreign->sequence = is_single ? single->sequence : ensemble->sequence;
        if (foreign->sequence == 0 && !foreign->loud)
            answer_ping(foreign);
    }
    dds_return_loan(from, sample, 1);
    return true;
}

/* The first of two parts, again and again: whoever counts it in gets numbers that are nobody's. */
static void make_noise(struct foreign *foreign)
{
    double numbers[COLUMNS] = {0};
    dds_sequence_double list = {._buffer = numbers, ._length = COLUMNS, ._maximum = COLUMNS};
    percuss_v1_EnsembleProgress progress = {
        .sequence = foreign->sequence, .done = 987654321, .samples = 987654321};
    percuss_v1_EnsembleSamples samples = {
        .sequence = foreign->sequence, .parts = 2, .columns = COLUMNS, .rows = list};
    percuss_v1_Trace trace = {
        .sequence = foreign->sequence, .parts = 2, .time = list, .force = list};
    memcpy(progress.client, foreign->client, sizeof progress.client);
    memcpy(samples.client, foreign->client, sizeof samples.client);
    memcpy(trace.client, foreign->client, sizeof trace.client);
    dds_write(foreign->progress, &progress);
    dds_write(foreign->samples, &samples);
    dds_write(foreign->trace, &trace);
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: wire_foreign DOMAIN late|loud\n");
        return 2;
    }
    static struct foreign foreign;
    foreign.loud = strcmp(argv[2], "loud") == 0;
    foreign.participant = checked(wire_participant_create((uint32_t)strtoul(argv[1], NULL, 10)));
    foreign.requests = reader(&foreign, &percuss_v1_Request_desc, WIRE_TOPIC_REQUEST);
    foreign.ensembles =
        reader(&foreign, &percuss_v1_EnsembleRequest_desc, WIRE_TOPIC_ENSEMBLE_REQUEST);
    puts("there");
    fflush(stdout);
    for (;;) {
        while (take(&foreign, foreign.requests) || take(&foreign, foreign.ensembles))
            continue;
        if (foreign.loud && foreign.sequence > 0)
            make_noise(&foreign);
        dds_sleepfor(DDS_MSECS(1));
    }
}
