/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "raw_link.h"

#include <stdlib.h>

#include "raw.h"
#include "samples.h"
#include "wire.h"

/* Serialised before the octets of data: representation header, `wanted` with padding, `busy`, their
 * number. */
enum { HEAD_BYTES = 24, MOST_BYTES = 1 << 20 };

static const double patience = 20.0; /* s */

struct raw_link {
    dds_entity_t participant, writer, reader, waitset;
    uint8_t *data; /* MOST_BYTES of zeros */
};

static dds_entity_t topic(const struct raw_link *link, const char *name)
{
    return dds_create_topic(link->participant, &bench_Payload_desc, name, NULL, NULL);
}

/* Either end; a failure shows in the entities, which are then negative. */
static struct raw_link *create(uint32_t domain, const char *to, const char *from)
{
    struct raw_link *link = calloc(1, sizeof *link);
    if (!link)
        return NULL;
    dds_qos_t *qos = wire_qos_exchange(NULL);
    link->data = calloc(1, MOST_BYTES);
    link->participant = wire_participant_create(domain);
    link->writer = dds_create_writer(link->participant, topic(link, to), qos, NULL);
    link->reader = dds_create_reader(link->participant, topic(link, from), qos, NULL);
    link->waitset = dds_create_waitset(link->participant);
    dds_delete_qos(qos);
    dds_set_status_mask(link->reader, DDS_DATA_AVAILABLE_STATUS);
    if (link->data && link->writer > 0 &&
        dds_waitset_attach(link->waitset, link->reader, 0) == DDS_RETCODE_OK)
        return link;
    raw_link_close(link);
    return NULL;
}

void raw_link_close(struct raw_link *link)
{
    if (!link)
        return;
    if (link->participant > 0)
        dds_delete(link->participant);
    free(link->data);
    free(link);
}

/* What a sample asks for. */
struct errand {
    size_t wanted; /* octets of the answer, serialised */
    double busy;   /* s */
};

static bool send(struct raw_link *link, size_t bytes, struct errand errand)
{
    size_t most = bytes < MOST_BYTES ? bytes : MOST_BYTES;
    uint32_t count = most > HEAD_BYTES ? (uint32_t)(most - HEAD_BYTES) : 0;
    bench_Payload payload = {
        .wanted = (uint32_t)errand.wanted,
        .busy = errand.busy,
        .data = {._buffer = link->data, ._length = count, ._maximum = count},
    };
    return dds_write(link->writer, &payload) == DDS_RETCODE_OK;
}

/* Takes one sample if there is one; true: it had data. */
static bool take(struct raw_link *link, struct errand *errand)
{
    void *sample[1] = {NULL};
    dds_sample_info_t info;
    dds_return_t count = dds_take(link->reader, sample, &info, 1, 1);
    bool valid = count == 1 && info.valid_data;
    if (valid) {
        const bench_Payload *payload = sample[0];
        *errand = (struct errand){payload->wanted, payload->busy};
    }
    if (count == 1)
        dds_return_loan(link->reader, sample, 1);
    return valid;
}

static bool receive(struct raw_link *link, double seconds)
{
    struct errand errand;
    double end = samples_now() + seconds;
    while (!take(link, &errand)) {
        double left = end - samples_now();
        if (left <= 0.0)
            return false;
        dds_waitset_wait(link->waitset, NULL, 0, (dds_duration_t)(left * 1e9) + 1);
    }
    return true;
}

struct raw_link *raw_link_open(uint32_t domain)
{
    struct raw_link *link = create(domain, "bench/Ping", "bench/Pong");
    double end = samples_now() + patience;
    /* until both directions are matched */
    while (link && samples_now() < end) {
        if (send(link, 0, (struct errand){0}) && receive(link, 0.05)) {
            while (receive(link, 0.05))
                continue;
            return link;
        }
    }
    raw_link_close(link);
    return NULL;
}

double raw_link_trip(struct raw_link *link, size_t request, size_t reply, double busy)
{
    double start = samples_now();
    bool answered = send(link, request, (struct errand){reply, busy}) && receive(link, patience);
    return answered ? samples_now() - start : -1.0;
}

void raw_echo(uint32_t domain)
{
    struct raw_link *link = create(domain, "bench/Pong", "bench/Ping");
    struct errand errand;
    while (link && dds_waitset_wait(link->waitset, NULL, 0, DDS_INFINITY) >= 0) {
        while (take(link, &errand)) {
            for (double end = samples_now() + errand.busy; samples_now() < end;)
                continue;
            send(link, errand.wanted, (struct errand){0});
        }
    }
    raw_link_close(link);
}
