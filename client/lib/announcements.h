/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Announcements of servers on topics that are kept for late readers: a new reader only waits for
 * the copies. */
#ifndef PERCUSS_LIB_ANNOUNCEMENTS_H
#define PERCUSS_LIB_ANNOUNCEMENTS_H

#include "client.h"

#define ANNOUNCEMENTS_INTERVAL DDS_MSECS(2) /* between two looks */

/* Samples lent by a reader, present instances only. */
struct announcements {
    dds_entity_t reader;
    int count;
    void **samples;
    dds_sample_info_t *infos;
};

/* The reader behind `slot`, a member of the client, made when first asked for. */
enum percuss_result announcements_open(struct percuss_client *client, dds_entity_t *slot,
                                       const dds_topic_descriptor_t *descriptor, const char *topic);

/* Lends all samples; some may be without valid data. NO_MEMORY or TRANSPORT: nothing to release. */
enum percuss_result announcements_read(struct percuss_client *client, dds_entity_t reader,
                                       struct announcements *all);
void announcements_release(struct announcements *all);

/* The id of the connected server; false when there is none, or it has gone. */
bool announcements_server(struct percuss_client *client, uint8_t server[16]);

/* The announcement of the connected server; or, for a client that only observes, of the one up
 * longest among the wanted ones. */
enum percuss_result announcements_connected(struct percuss_client *client, double timeout,
                                            struct percuss_server *server);

#endif
