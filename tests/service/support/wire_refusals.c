/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bad requests of every kind, straight on the wire: each gets its status and a message that names
 * the field, no number, and the server goes on. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

static struct scene scene;
static uint64_t sequence;

/* Sends the scene and returns the reply's status after looking at its message and numbers. */
static void expect(struct peer *peer, unsigned status, const char *fragment)
{
    peer_send(peer, &scene.request);
    const percuss_v1_Reply *reply = peer_receive(peer, PEER_SINGLE, 5.0);
    REQUIRE(reply->sequence == sequence, "another reply");
    REQUIRE(reply->status == status && strstr(reply->message, fragment),
            "status %u: \"%s\"; expected %u with \"%s\"", reply->status, reply->message, status,
            fragment);
    if (status != percuss_v1_STATUS_OK) {
        REQUIRE(reply->contacts._length == 0 && reply->states_after._length == 0,
                "a refusal with lists");
        REQUIRE(isnan(reply->energy.available) && isnan(reply->error.restitution_time) &&
                    isnan(reply->window),
                "a refusal with numbers");
    }
    peer_return(peer, PEER_SINGLE, reply);
    scene_fill(&scene, ++sequence, 0.3);
}

#define BAD(lvalue, value, fragment)                                                               \
    do {                                                                                           \
        scene.lvalue = (value);                                                                    \
        expect(peer, percuss_v1_STATUS_BAD_REQUEST, fragment);                                     \
    } while (0)

static void bad_bodies(struct peer *peer)
{
    BAD(request.bodies._length, 0, "bodies: 0 given");
    BAD(bodies[0].id[0], '\0', "bodies[0].id: empty");
    BAD(bodies[0].id[3], '\t', "bodies[0].id: byte 0x09");
    BAD(bodies[0].position[1], NAN, "bodies[0].position: (0, nan, 0.025)");
    BAD(bodies[0].position[1], INFINITY, "bodies[0].position");
    BAD(bodies[1].orientation[0], 0.0, "bodies[1].orientation");
    BAD(bodies[0].velocity[2], NAN, "bodies[0].velocity");
    BAD(bodies[0].angular_velocity[2], -INFINITY, "bodies[0].angular_velocity");
    BAD(bodies[0].elapsed, -1.0, "bodies[0].elapsed: -1");
    BAD(bodies[0].specimen[0], 's', "bodies[0].specimen: s");
    snprintf(scene.bodies[1].id, sizeof scene.bodies[1].id, "no-such-body");
    expect(peer, percuss_v1_STATUS_UNKNOWN_BODY, "no-such-body");
    snprintf(scene.bodies[1].state, sizeof scene.bodies[1].state, "no-such-state");
    expect(peer, percuss_v1_STATUS_UNKNOWN_STATE, "bodies[1].state: no-such-state");
}

static void bad_contacts(struct peer *peer)
{
    BAD(request.contacts._length, 0, "contacts: 0 given");
    BAD(contacts[0].a, 2, "contacts[0].a: 2");
    BAD(contacts[0].b, 4294967295u, "contacts[0].b: 4294967295");
    BAD(contacts[0].b, 0, "contacts[0].b: 0");
    BAD(contacts[0].point[0], NAN, "contacts[0].point");
    BAD(contacts[0].normal[2], 2.0, "contacts[0].normal: (0, 0, 2): must be a unit vector");
    BAD(contacts[0].normal[2], NAN, "contacts[0].normal");
    BAD(contacts[0].gap, NAN, "contacts[0].gap: nan");
    BAD(contacts[0].gap_acceleration, INFINITY, "contacts[0].gap_acceleration: inf");
    BAD(contacts[0].normal[2], -1.0, "normal");
    scene.bodies[0].velocity[2] = 0.3;
    expect(peer, percuss_v1_STATUS_NOT_APPROACHING, "");
}

static void bad_options(struct peer *peer)
{
    BAD(request.options.tolerance, -1.0, "options.tolerance: -1");
    BAD(request.options.tolerance, NAN, "options.tolerance: nan");
    BAD(request.options.horizon, 1e9, "options.horizon: 1e+09");
    BAD(request.options.contact_model, 99, "options.contact_model: 99");
    BAD(request.options.method, 99, "options.method: 99");
    BAD(request.options.compliance, 99, "options.compliance: 99");
    BAD(request.options.dents, 99, "options.dents: 99");
    BAD(request.options.deadline, -1.0, "options.deadline: -1");
}

static void bad_delassus(struct peer *peer)
{
    scene.delassus[0] = 10.0;
    BAD(request.delassus._length, 2, "delassus: 2 numbers");
    scene.delassus[0] = -10.0;
    BAD(request.delassus._length, 1, "delassus[0][0]: -10");
    scene.delassus[0] = NAN;
    BAD(request.delassus._length, 1, "delassus[0][0]: nan");
    /* of three rows a contact the tangents' must be numbers as well */
    memset(scene.delassus, 0, 9 * sizeof *scene.delassus);
    scene.delassus[0] = 10.0;
    scene.delassus[8] = -1.0;
    BAD(request.delassus._length, 9, "delassus[2][2]: -1: must be finite and >= 0");
    BAD(request.delassus._length, 36, "delassus: 36 numbers");
}

/* A batch of none is refused; bad members are refused one by one, the good ones answered. */
static void bad_batches(struct peer *peer)
{
    static struct scene scenes[4];
    percuss_v1_Request requests[4];
    percuss_v1_BatchRequest batch = {.sequence = 1, .requests = {._buffer = requests}};
    peer_send_batch(peer, &batch);
    const percuss_v1_BatchReply *reply = peer_receive(peer, PEER_BATCH, 5.0);
    REQUIRE(reply->status == percuss_v1_STATUS_BAD_REQUEST && strstr(reply->message, "requests:") &&
                reply->part == 0 && reply->parts == 1 && reply->replies._length == 0,
            "an empty batch: status %u: %s", reply->status, reply->message);
    peer_return(peer, PEER_BATCH, reply);
    for (uint64_t i = 0; i < 4; i++) {
        scene_fill(&scenes[i], 100 + i, 0.3);
        requests[i] = scenes[i].request;
    }
    requests[1].options.tolerance = NAN;
    strcpy(scenes[3].bodies[0].specimen, "ball");
    batch.sequence = 2;
    batch.requests._length = batch.requests._maximum = 4;
    peer_send_batch(peer, &batch);
    reply = peer_receive(peer, PEER_BATCH, 5.0);
    REQUIRE(reply->status == percuss_v1_STATUS_OK && reply->replies._length == 4,
            "status %u, %u replies", reply->status, reply->replies._length);
    const unsigned expected[] = {percuss_v1_STATUS_OK, percuss_v1_STATUS_BAD_REQUEST,
                                 percuss_v1_STATUS_OK, percuss_v1_STATUS_BAD_REQUEST};
    for (uint64_t i = 0; i < 4; i++)
        REQUIRE(reply->replies._buffer[i].status == expected[i] &&
                    reply->replies._buffer[i].sequence == 100 + i,
                "member %u: status %u", (unsigned)i, reply->replies._buffer[i].status);
    REQUIRE(strstr(reply->replies._buffer[3].message, "bodies[0].specimen: ball: must be empty in"),
            "%s", reply->replies._buffer[3].message);
    peer_return(peer, PEER_BATCH, reply);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: wire_refusals DOMAIN\n");
        return 2;
    }
    struct peer peer;
    peer_open(&peer, (uint32_t)strtoul(argv[1], NULL, 10));
    scene_fill(&scene, ++sequence, 0.3);
    bad_bodies(&peer);
    bad_contacts(&peer);
    bad_options(&peer);
    bad_delassus(&peer);
    bad_batches(&peer);
    expect(&peer, percuss_v1_STATUS_OK, "");
    peer_close(&peer);
    printf("%llu requests got the status they should\n", (unsigned long long)sequence - 1);
    return EXIT_SUCCESS;
}
