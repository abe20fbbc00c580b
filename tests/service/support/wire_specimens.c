/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A rig that hits one specimen many times under the same client id, and does not know the end of a
 * burst. Every reply goes into a file as it comes: its number, its restitution, and its XCDR2 bytes
 * in hexadecimal. The next run asks everything again and compares what the file holds already. With
 * a PROCESS it kills that process as soon as the file holds KNOWN replies, and ends.
 *
 * usage: wire_specimens DOMAIN SPECIMEN COUNT FILE [PROCESS KNOWN] */
#include <dds/ddsi/ddsi_serdata.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

enum { LINE = 1 << 17, MOST = 1000 };

static const double patience = 30.0; /* s */

struct rig {
    struct peer peer;
    const char *specimen, *file;
    unsigned count, answered, repeated;
    unsigned held, enough; /* replies in the file; 0: no limit */
    char *known[MOST + 1]; /* the line of a reply, by number */
};

static void read_known(struct rig *rig)
{
    static char line[LINE];
    FILE *file = fopen(rig->file, "r");
    while (file && fgets(line, sizeof line, file)) {
        unsigned number = (unsigned)strtoul(line, NULL, 10);
        /* the last line may have been cut off */
        if (number >= 1 && number <= rig->count && strchr(line, '\n') && !rig->known[number]) {
            rig->known[number] = strdup(line);
            rig->held++;
        }
    }
    if (file)
        fclose(file);
}

/* The sphere falls on the end of the rod. */
static void send_all(struct rig *rig)
{
    static struct scene scene;
    for (unsigned i = 1; i <= rig->count; i++) {
        scene_fill(&scene, i, 0.3);
        percuss_v1_BodyMotion *sphere = &scene.bodies[0], *rod = &scene.bodies[1];
        memset(sphere->position, 0, sizeof sphere->position);
        memset(sphere->velocity, 0, sizeof sphere->velocity);
        sphere->position[0] = 0.515;
        sphere->velocity[0] = -0.3;
        snprintf(rod->id, sizeof rod->id, "al-rod-1");
        snprintf(rod->specimen, sizeof rod->specimen, "%s", rig->specimen);
        scene.contacts[0] =
            (percuss_v1_Contact){.a = 0, .b = 1, .point = {0.5, 0, 0}, .normal = {1, 0, 0}};
        scene.request.options.contact_model = percuss_v1_CONTACT_MODEL_CLOSED_FORM;
        scene.request.options.compliance = percuss_v1_COMPLIANCE_HALF_SPACE;
        peer_send(&rig->peer, &scene.request);
    }
}

/* "NUMBER RESTITUTION BYTES\n" */
static void describe(const percuss_v1_Reply *reply, struct ddsi_serdata *serdata, char *line)
{
    ddsrt_iovec_t data;
    struct ddsi_serdata *held =
        ddsi_serdata_to_ser_ref(serdata, 0, ddsi_serdata_size(serdata), &data);
    REQUIRE(2 * data.iov_len + 64 < LINE, "a reply of %zu bytes", (size_t)data.iov_len);
    REQUIRE(reply->status == percuss_v1_STATUS_OK && reply->contacts._length == 1, "%s",
            reply->message);
    char *end = line + sprintf(line, "%llu %.17g ", (unsigned long long)reply->sequence,
                               reply->contacts._buffer[0].restitution);
    for (size_t i = 0; i < data.iov_len; i++)
        end += sprintf(end, "%02x", ((const uint8_t *)data.iov_base)[i]);
    strcpy(end, "\n");
    ddsi_serdata_to_ser_unref(held, &data);
}

static void note(struct rig *rig, struct ddsi_serdata *serdata)
{
    static char line[LINE];
    percuss_v1_Reply *reply = dds_alloc(sizeof *reply);
    memset(reply, 0, sizeof *reply);
    REQUIRE(ddsi_serdata_to_sample(serdata, reply, NULL, NULL), "a reply cannot be decoded");
    unsigned number = (unsigned)reply->sequence;
    if (number > 0) {
        REQUIRE(number <= rig->count, "a reply to %u", number);
        describe(reply, serdata, line);
        rig->answered++;
        rig->repeated += rig->known[number] != NULL;
        REQUIRE(!rig->known[number] || strcmp(rig->known[number], line) == 0,
                "another reply to %u:\n%s%s", number, rig->known[number], line);
        if (!rig->known[number]) {
            /* by itself: whoever is killed later has it */
            FILE *file = fopen(rig->file, "a");
            REQUIRE(file && fputs(line, file) >= 0 && fclose(file) == 0, "%s", rig->file);
            rig->known[number] = strdup(line);
            rig->held++;
        }
    }
    dds_sample_free(reply, &percuss_v1_Reply_desc, DDS_FREE_ALL);
}

static void receive_all(struct rig *rig)
{
    double end = peer_now() + patience;
    while (rig->answered < rig->count && (!rig->enough || rig->held < rig->enough)) {
        struct ddsi_serdata *serdata = NULL;
        dds_sample_info_t info;
        REQUIRE(peer_now() < end, "%u of %u answered", rig->answered, rig->count);
        dds_return_t count =
            dds_takecdr(rig->peer.readers[PEER_SINGLE], &serdata, 1, &info, DDS_ANY_STATE);
        if (count == 1) {
            if (info.valid_data)
                note(rig, serdata);
            ddsi_serdata_unref(serdata);
        } else {
            dds_waitset_wait(rig->peer.waitsets[PEER_SINGLE], NULL, 0, DDS_MSECS(100));
        }
    }
}

int main(int argc, char **argv)
{
    static struct rig rig;
    REQUIRE(argc == 5 || argc == 7,
            "usage: wire_specimens DOMAIN SPECIMEN COUNT FILE [PROCESS KNOWN]");
    rig.specimen = argv[2];
    rig.count = (unsigned)strtoul(argv[3], NULL, 10);
    rig.file = argv[4];
    rig.enough = argc == 7 ? (unsigned)strtoul(argv[6], NULL, 10) : 0;
    REQUIRE(rig.count <= MOST, "at most %d", MOST);
    memcpy(rig.peer.client, "a rig's own name", sizeof rig.peer.client);
    read_known(&rig);
    peer_open_as(&rig.peer, (uint32_t)strtoul(argv[1], NULL, 10));
    send_all(&rig);
    receive_all(&rig);
    if (rig.enough)
        kill((pid_t)strtol(argv[5], NULL, 10), SIGKILL);
    printf("%u answered, %u of them again\n", rig.answered, rig.repeated);
    peer_close(&rig.peer);
    return EXIT_SUCCESS;
}
