/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client of percuss-ros2 on plain Cyclone DDS: on the topics as any vendor's, or of the service
 * as rmw_cyclonedds makes one; or on the topics with a reader of replies that comes 0.3 s after the
 * questions. Asks about a steel sphere on the end of a rod, `count` questions at
 * once, and prints the restitution of each; with FRICTION, the sphere slides half as fast as it
 * comes, and the impulse vector is printed. usage: ros2_peer DOMAIN topic|late|service SPEED COUNT
 * [BODY [FRICTION]]; exit code 1: an answer is missing */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "percuss_msgs.h"
#include "wire.h"

enum { MOST = 64, MILLISECONDS = 20000 };

struct peer {
    dds_entity_t writer, reader;
    bool service, late;
    uint64_t id;
    unsigned count, answered, strangers;
    double friction, delassus[9];
    uint32_t delassus_count;
    double restitution[MOST], vector[MOST][3];
    char message[MOST][256];
};

static void ask(struct peer *peer, unsigned number, double speed, char *body)
{
    static char none[] = "";
    percuss_msgs_msg_dds__BodyMotion_ bodies[2] = {
        {.id = (char *)"steel-sphere", .state = none, .specimen = none},
        {.id = body, .state = none, .specimen = none}};
    percuss_msgs_msg_dds__Contact_ contact = {
        .a = 0, .b = 1, .point.x = 0.5, .normal.x = 1.0, .friction = peer->friction};
    percuss_msgs_msg_dds__Question_ question = {
        .bodies = {._length = 2, ._buffer = bodies},
        .contacts = {._length = 1, ._buffer = &contact},
        .delassus = {._length = peer->delassus_count, ._buffer = peer->delassus}};
    bodies[0].position.x = 0.515;
    bodies[0].velocity.x = -speed;
    bodies[0].velocity.y = peer->friction > 0.0 ? 0.5 * speed : 0.0;
    bodies[0].orientation.w = bodies[1].orientation.w = 1.0;
    percuss_msgs_msg_dds__Request_ request = {.sequence_number = number, .question = question};
    percuss_msgs_srv_dds__Impact_Request_ call = {
        .header_guid = peer->id, .header_number = number, .question = question};
    memcpy(request.client, &peer->id, sizeof peer->id);
    if (dds_write(peer->writer, peer->service ? (void *)&call : &request) < 0)
        exit(EXIT_FAILURE);
}

static void note(struct peer *peer, uint64_t id, uint64_t number,
                 const percuss_msgs_msg_dds__Answer_ *answer)
{
    if (id != peer->id || number >= peer->count) {
        peer->strangers++;
        return;
    }
    peer->answered++;
    snprintf(peer->message[number], sizeof peer->message[number], "%u %s", answer->status,
             answer->message);
    peer->restitution[number] = -1.0;
    if (answer->contacts._length != 1)
        return;
    const percuss_msgs_msg_dds__ContactResult_ *contact = answer->contacts._buffer;
    peer->restitution[number] = contact->restitution;
    peer->vector[number][0] = contact->impulse_vector.x;
    peer->vector[number][1] = contact->impulse_vector.y;
    peer->vector[number][2] = contact->impulse_vector.z;
}

static void take(struct peer *peer)
{
    void *sample = NULL;
    dds_sample_info_t info;
    while (dds_take(peer->reader, &sample, &info, 1, 1) == 1) {
        uint64_t id;
        const percuss_msgs_msg_dds__Reply_ *reply = sample;
        const percuss_msgs_srv_dds__Impact_Response_ *response = sample;
        if (info.valid_data && peer->service) {
            note(peer, response->header_guid, (uint64_t)response->header_number, &response->answer);
        } else if (info.valid_data) {
            memcpy(&id, reply->client, sizeof id);
            note(peer, id, reply->sequence_number, &reply->answer);
        }
        dds_return_loan(peer->reader, &sample, 1);
    }
}

/* The service's id, by which the two ends of a server belong together. */
static bool names_server(dds_entity_t end, bool reader)
{
    dds_instance_handle_t peers[8];
    void *data = NULL;
    size_t size = 0;
    int count = reader ? dds_get_matched_publications(end, peers, 8)
                       : dds_get_matched_subscriptions(end, peers, 8);
    if (count != 1)
        return false;
    dds_builtintopic_endpoint_t *endpoint = reader
                                                ? dds_get_matched_publication_data(end, peers[0])
                                                : dds_get_matched_subscription_data(end, peers[0]);
    bool named = endpoint && dds_qget_userdata(endpoint->qos, &data, &size) && size > 10 &&
                 memcmp(data, "serviceid=", 10) == 0;
    dds_free(data);
    dds_builtintopic_free_endpoint(endpoint);
    return named;
}

static bool is_matched(const struct peer *peer)
{
    dds_publication_matched_status_t written;
    dds_subscription_matched_status_t read;
    if (peer->service)
        return names_server(peer->writer, false) && names_server(peer->reader, true);
    if (dds_get_publication_matched_status(peer->writer, &written) != 0)
        return false;
    if (peer->late)
        return written.current_count == 1;
    return dds_get_subscription_matched_status(peer->reader, &read) == 0 &&
           written.current_count == 1 && read.current_count == 1;
}

static void open_reader(struct peer *peer, dds_entity_t participant, dds_qos_t *qos)
{
    dds_entity_t answers =
        dds_create_topic(participant,
                         peer->service ? &percuss_msgs_srv_dds__Impact_Response__desc
                                       : &percuss_msgs_msg_dds__Reply__desc,
                         peer->service ? "rr/percuss/impactReply" : "rt/percuss/reply", NULL, NULL);
    peer->reader = dds_create_reader(participant, answers, qos, NULL);
}

static void open_ends(struct peer *peer, uint32_t domain)
{
    char name[64];
    dds_entity_t participant = wire_participant_create(domain);
    dds_qos_t *qos = wire_qos_exchange(NULL);
    peer->id = (uint64_t)getpid() << 32 | 4711;
    snprintf(name, sizeof name, "clientid=%016llx;", (unsigned long long)peer->id);
    if (peer->service)
        dds_qset_userdata(qos, name, strlen(name));
    /* names and types as ROS 2 mangles them */
    dds_entity_t asked = dds_create_topic(
        participant,
        peer->service ? &percuss_msgs_srv_dds__Impact_Request__desc
                      : &percuss_msgs_msg_dds__Request__desc,
        peer->service ? "rq/percuss/impactRequest" : "rt/percuss/request", NULL, NULL);
    peer->writer = dds_create_writer(participant, asked, qos, NULL);
    if (!peer->late)
        open_reader(peer, participant, qos);
    dds_delete_qos(qos);
}

/* Numbers with commas between them. */
static void read_delassus(struct peer *peer, const char *text)
{
    char *end = (char *)text;
    while (*end && peer->delassus_count < 9) {
        peer->delassus[peer->delassus_count++] = strtod(end, &end);
        end += *end == ',';
    }
}

int main(int argc, char **argv)
{
    static struct peer peer;
    if (argc < 5 || strtoul(argv[4], NULL, 10) > MOST)
        return 2;
    peer.service = strcmp(argv[2], "service") == 0;
    peer.late = strcmp(argv[2], "late") == 0;
    peer.count = (unsigned)strtoul(argv[4], NULL, 10);
    peer.friction = argc > 6 ? strtod(argv[6], NULL) : 0.0;
    if (argc > 7)
        read_delassus(&peer, argv[7]);
    open_ends(&peer, (uint32_t)strtoul(argv[1], NULL, 10));
    /* one bridge, then all questions, then all answers */
    for (int i = 0; i < MILLISECONDS && !is_matched(&peer); i++)
        dds_sleepfor(DDS_MSECS(1));
    double speed = strtod(argv[3], NULL);
    for (unsigned i = 0; i < peer.count; i++)
        ask(&peer, i, speed * (i + 1), argc > 5 ? argv[5] : (char *)"al-rod-1");
    if (peer.late) {
        dds_qos_t *qos = wire_qos_exchange(NULL);
        dds_sleepfor(DDS_MSECS(300));
        open_reader(&peer, dds_get_participant(peer.writer), qos);
        dds_delete_qos(qos);
    }
    for (int i = 0; i < MILLISECONDS && peer.answered < peer.count; i++) {
        take(&peer);
        dds_sleepfor(DDS_MSECS(1));
    }
    for (unsigned i = 0; i < peer.count; i++)
        printf("%u: %.17g %s\n", i, peer.restitution[i], peer.message[i]);
    for (unsigned i = 0; peer.friction > 0.0 && i < peer.count; i++)
        printf("vector %.17g %.17g %.17g\n", peer.vector[i][0], peer.vector[i][1],
               peer.vector[i][2]);
    printf("%u answered, %u of others\n", peer.answered, peer.strangers);
    return peer.answered == peer.count ? EXIT_SUCCESS : EXIT_FAILURE;
}
