/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The bytes that Cyclone DDS puts on the network for a message of percuss_msgs, and back: reads a
 * sample of `TYPE` from standard input as CDR with its head, gives it to Cyclone, and writes the
 * bytes that Cyclone makes of what it has read. usage: ros2_bytes TYPE <CDR >CDR; exit code 3:
 * Cyclone does not take it */

#include <dds/ddsi/ddsi_serdata.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "percuss_msgs.h"
#include "wire.h"

enum { MOST = 1 << 20, DOMAIN_OF_ITS_OWN = 199 };

static const dds_topic_descriptor_t *find(const char *name)
{
    static const struct {
        const char *name;
        const dds_topic_descriptor_t *type;
    } types[] = {{"Request", &percuss_msgs_msg_dds__Request__desc},
                 {"Reply", &percuss_msgs_msg_dds__Reply__desc},
                 {"BodyList", &percuss_msgs_msg_dds__BodyList__desc},
                 {"Impact_Request", &percuss_msgs_srv_dds__Impact_Request__desc},
                 {"Impact_Response", &percuss_msgs_srv_dds__Impact_Response__desc}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(name, types[i].name) == 0)
            return types[i].type;
    return NULL;
}

int main(int argc, char **argv)
{
    static unsigned char bytes[MOST];
    const dds_topic_descriptor_t *type = argc == 2 ? find(argv[1]) : NULL;
    size_t size = fread(bytes, 1, sizeof bytes, stdin);
    dds_entity_t participant = wire_participant_create(DOMAIN_OF_ITS_OWN);
    if (!type || participant < 0)
        return 2;
    dds_entity_t topic = dds_create_topic(participant, type, "bytes", NULL, NULL);
    /* the type as Cyclone has it: that of an empty sample on its way */
    struct ddsi_serdata *empty = NULL;
    dds_sample_info_t info;
    dds_entity_t reader = dds_create_reader(participant, topic, NULL, NULL);
    dds_entity_t writer = dds_create_writer(participant, topic, NULL, NULL);
    void *sample = dds_alloc(type->m_size);
    if (!sample || reader < 0 || dds_write(writer, sample) < 0 ||
        dds_takecdr(reader, &empty, 1, &info, DDS_ANY_STATE) != 1)
        return 2;
    const struct ddsi_sertype *sertype = empty->type;
    /* bytes to a sample */
    ddsrt_iovec_t whole = {.iov_base = bytes, .iov_len = size};
    struct ddsi_serdata *taken = ddsi_serdata_from_ser_iov(sertype, SDK_DATA, 1, &whole, size);
    if (!taken)
        return 3;
    if (!ddsi_serdata_to_sample(taken, sample, NULL, NULL))
        return 3;
    /* and a sample to bytes */
    struct ddsi_serdata *made = ddsi_serdata_from_sample(sertype, SDK_DATA, sample);
    uint32_t length = made ? ddsi_serdata_size(made) : 0;
    if (length == 0 || length > MOST)
        return 3;
    ddsi_serdata_to_ser(made, 0, length, bytes);
    fwrite(bytes, 1, length, stdout);
    ddsi_serdata_unref(made);
    ddsi_serdata_unref(taken);
    ddsi_serdata_unref(empty);
    dds_sample_free(sample, type, DDS_FREE_ALL);
    dds_delete(participant);
    return EXIT_SUCCESS;
}
