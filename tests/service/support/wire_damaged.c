/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A peer that means harm: it writes samples that are cut anywhere, with wrong lengths or changed
 * bytes, in both byte orders, past the writing half of DDS which would not make such.
 * usage: wire_damaged requests DOMAIN COUNT   to the daemon: requests and orders to forget dents
 *        wire_damaged replies DOMAIN SECONDS  to every client that appears: replies and
 * announcements; only such as are not whole, so that none can be believed */
#include <dds/ddsi/ddsi_serdata_default.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"
#include "unit/wire/any_sample.h"
#include "wire_topic.h"
#include "wire_whole.h"

enum { ENCAPSULATION = 4, MOST_CLIENTS = 64, PACE = 500000 /* ns between samples */ };

/* Indices into any_types. */
static const int to_daemon[] = {0, 2, 4, 11};
static const int to_clients[] = {1, 3, 5, 6, 7, 8};
static const int to_everybody[] = {9, 10, 11};

struct target {
    int type; /* index into any_types */
    const struct ddsi_sertype *sertype;
    dds_entity_t writer;
};

static dds_entity_t participant;
static unsigned written;

static struct target create_target(int type, const char *partition, bool announcement)
{
    struct target target = {.type = type};
    dds_entity_t topic = wire_topic_create_typed(participant, any_types[type].type,
                                                 any_types[type].topic, &target.sertype);
    dds_qos_t *qos = announcement ? wire_qos_announcement(NULL) : wire_qos_exchange(partition);
    target.writer = dds_create_writer(participant, topic, qos, NULL);
    dds_delete_qos(qos);
    REQUIRE(topic > 0 && target.writer > 0, "%s: cannot be written", any_types[type].topic);
    return target;
}

/* Cut anywhere, most often with a size in front that says so; or changed in one place. */
static void damage(struct any_bytes *bytes, bool swapped)
{
    static const uint32_t wrong[] = {0, 1, 3, 128, 0x7fffffff, 0x80000001, UINT32_MAX};
    size_t size = bytes->size;
    switch (any_number() % 4) {
    case 0:
        any_put(bytes->data + any_number() % (size / 4) * 4,
                wrong[any_number() % (sizeof wrong / sizeof *wrong)], swapped);
        break;
    case 1:
        bytes->data[any_number() % size] = (uint8_t)any_number();
        break;
    default:
        bytes->size = 4 + any_number() % (size - 4);
        if (any_number() % 8)
            any_put(bytes->data, bytes->size - 4, swapped);
    }
}

/* A good sample of this size, made by DDS, gets these bytes. */
static void write_bytes(struct target *target, const struct any_bytes *good,
                        const struct any_bytes *bytes, bool swapped)
{
    uint8_t header[ENCAPSULATION] = {0, 9, 0, 0};
    ddsrt_iovec_t pieces[2] = {{header, sizeof header}, {good->data, good->size}};
    struct ddsi_serdata *sample =
        ddsi_serdata_from_ser_iov(target->sertype, SDK_DATA, 2, pieces, sizeof header + good->size);
    ddsrt_iovec_t inside;
    REQUIRE(sample, "%s: a good sample is refused", any_types[target->type].topic);
    struct ddsi_serdata *held =
        ddsi_serdata_to_ser_ref(sample, 0, ENCAPSULATION + good->size, &inside);
    uint8_t *data = inside.iov_base;
    data[1] = swapped ? 8 : 9;
    memcpy(data + ENCAPSULATION, bytes->data, bytes->size);
    ((struct ddsi_serdata_default *)sample)->pos = (uint32_t)bytes->size;
    ddsi_serdata_to_ser_unref(held, &inside);
    /* gives the sample away */
    dds_writecdr(target->writer, sample);
    written++;
}

/* `client`: whose, for types that begin with it; NULL: whose the sample says. `harmless`: also
 * samples that are whole by chance. */
static void attack(struct target *target, const uint8_t *client, bool harmless)
{
    const dds_topic_descriptor_t *type = any_types[target->type].type;
    bool swapped = any_number() % 2;
    struct any_bytes good, bytes;
    any_sample_twice(type, &good, &bytes, swapped);
    if (client) {
        memcpy(good.data + 4, client, 16);
        memcpy(bytes.data + 4, client, 16);
    }
    damage(&bytes, swapped);
    if (harmless || !wire_whole(type->m_ops, bytes.data, bytes.size, swapped)) {
        write_bytes(target, &good, &bytes, swapped);
        dds_sleepfor(PACE);
    }
    free(good.data);
    free(bytes.data);
}

static void wait_for_reader(dds_entity_t writer)
{
    dds_instance_handle_t other;
    for (double end = peer_now() + 20.0; dds_get_matched_subscriptions(writer, &other, 1) < 1;) {
        REQUIRE(peer_now() < end, "no daemon");
        dds_sleepfor(DDS_MSECS(2));
    }
}

static void attack_daemon(unsigned count)
{
    enum { TARGETS = sizeof to_daemon / sizeof *to_daemon };
    struct target targets[TARGETS];
    for (int i = 0; i < TARGETS; i++) {
        targets[i] = create_target(to_daemon[i], NULL, false);
        wait_for_reader(targets[i].writer);
    }
    while (written < count)
        attack(&targets[any_number() % TARGETS], NULL, true);
}

/* The reply topics of one client. */
struct victim {
    char partition[WIRE_REPLIES_SIZE];
    uint8_t id[16];
    struct target targets[sizeof to_clients / sizeof *to_clients];
};
/* a name of "c_" and 32 digits: that client is in no other partition */
enum { PLAIN_LENGTH = 34 };
enum { REPLY_TOPICS = sizeof to_clients / sizeof *to_clients };

static void open_victim(struct victim *victim, const char *partition)
{
    snprintf(victim->partition, sizeof victim->partition, "%s", partition);
    for (int i = 0; i < 16; i++) {
        unsigned octet;
        REQUIRE(sscanf(partition + 2 + 2 * i, "%2x", &octet) == 1, "%s", partition);
        victim->id[i] = (uint8_t)octet;
    }
    for (int i = 0; i < REPLY_TOPICS; i++)
        victim->targets[i] = create_target(to_clients[i], partition, false);
}

/* Clients whose readers have appeared. */
static size_t find_victims(dds_entity_t subscriptions, struct victim *victims, size_t count)
{
    void *sample[1] = {NULL};
    dds_sample_info_t info;
    while (dds_take(subscriptions, sample, &info, 1, 1) == 1) {
        const dds_builtintopic_endpoint_t *reader = sample[0];
        uint32_t partitions = 0;
        char **names = NULL;
        if (info.valid_data && strcmp(reader->topic_name, WIRE_TOPIC_REPLY) == 0)
            dds_qget_partition(reader->qos, &partitions, &names);
        if (partitions == 1 && strlen(names[0]) == PLAIN_LENGTH && count < MOST_CLIENTS)
            open_victim(&victims[count++], names[0]);
        for (uint32_t i = 0; i < partitions; i++)
            dds_free(names[i]);
        dds_free(names);
        dds_return_loan(subscriptions, sample, 1);
    }
    return count;
}

static void attack_clients(double seconds)
{
    enum { ANNOUNCEMENTS = sizeof to_everybody / sizeof *to_everybody };
    static struct victim victims[MOST_CLIENTS];
    struct target announcements[ANNOUNCEMENTS];
    size_t count = 0;
    for (int i = 0; i < ANNOUNCEMENTS; i++)
        announcements[i] = create_target(to_everybody[i], NULL, true);
    dds_entity_t subscriptions =
        dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, NULL, NULL);
    for (double end = peer_now() + seconds; peer_now() < end;) {
        count = find_victims(subscriptions, victims, count);
        attack(&announcements[any_number() % ANNOUNCEMENTS], NULL, false);
        /* the latest client is the one that is still there */
        if (count)
            attack(&victims[count - 1].targets[any_number() % REPLY_TOPICS], victims[count - 1].id,
                   false);
    }
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: wire_damaged requests|replies DOMAIN COUNT|SECONDS\n");
        return 2;
    }
    participant = wire_participant_create((uint32_t)strtoul(argv[2], NULL, 10));
    REQUIRE(participant > 0, "no participant");
    if (strcmp(argv[1], "requests") == 0)
        attack_daemon((unsigned)strtoul(argv[3], NULL, 10));
    else
        attack_clients(strtod(argv[3], NULL));
    /* what is on its way arrives */
    dds_sleepfor(DDS_MSECS(300));
    dds_delete(dds_get_parent(participant));
    printf("%u damaged samples written\n", written);
    return EXIT_SUCCESS;
}
