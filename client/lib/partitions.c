/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "partitions.h"

#include <stdio.h>
#include <string.h>

enum { MOST_NAMES = 4, TAKEN_AT_ONCE = 32 };

struct names {
    char name[MOST_NAMES][WIRE_PARTITION_SIZE];
    size_t count;
};

/* Each name once; there may be more than are worth naming. */
static void add(struct names *names, const char *name)
{
    for (size_t i = 0; i < names->count; i++)
        if (strcmp(names->name[i], name) == 0)
            return;
    if (names->count < MOST_NAMES && strlen(name) < WIRE_PARTITION_SIZE)
        strcpy(names->name[names->count++], name);
}

/* The partition of a writer of announcements; empty: none. */
static void add_writer(struct names *names, const dds_builtintopic_endpoint_t *writer)
{
    uint32_t count = 0;
    char **partitions = NULL;
    if (strcmp(writer->topic_name, WIRE_TOPIC_SERVER_STATUS) != 0)
        return;
    dds_qget_partition(writer->qos, &count, &partitions);
    add(names, count > 0 ? partitions[0] : "");
    for (uint32_t i = 0; i < count; i++)
        dds_free(partitions[i]);
    dds_free(partitions);
}

/* DDS tells of all writers of the domain, whatever their partition. */
static void take(dds_entity_t publications, struct names *names)
{
    void *samples[TAKEN_AT_ONCE] = {NULL};
    dds_sample_info_t infos[TAKEN_AT_ONCE];
    dds_return_t count;
    while ((count = dds_take(publications, samples, infos, TAKEN_AT_ONCE, TAKEN_AT_ONCE)) > 0) {
        for (dds_return_t i = 0; i < count; i++)
            if (infos[i].valid_data)
                add_writer(names, samples[i]);
        dds_return_loan(publications, samples, count);
    }
}

void partitions_list(const struct percuss_client *client, char *text, size_t size)
{
    struct names names = {.count = 0};
    size_t length = 0;
    *text = '\0';
    dds_entity_t publications =
        dds_create_reader(client->participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL);
    if (publications < 0)
        return;
    take(publications, &names);
    dds_delete(publications);
    /* those in our own would have been found */
    for (size_t i = 0; i < names.count && length < size; i++) {
        const char *name = names.name[i];
        if (strcmp(name, client->partition) != 0)
            length += (size_t)snprintf(text + length, size - length, "%s in %s%s",
                                       length ? ", one" : "; one is",
                                       *name ? "partition " : "no partition", name);
    }
}
