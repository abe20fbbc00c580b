/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the wire promises about replies: the same to a repeated request, state tokens, deadlines,
 * batches equal to single requests. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

static const percuss_v1_Reply *ask(struct peer *peer, struct scene *scene)
{
    peer_send(peer, &scene->request);
    return peer_receive(peer, PEER_SINGLE, 10.0);
}

static bool equal(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* The numbers of a reply, to the last bit, without timing. */
static void require_same(const percuss_v1_Reply *a, const percuss_v1_Reply *b)
{
    REQUIRE(a->status == b->status && strcmp(a->message, b->message) == 0, "%u %s, %u %s",
            a->status, a->message, b->status, b->message);
    REQUIRE(a->contacts._length == b->contacts._length, "number of contacts");
    for (uint32_t i = 0; i < a->contacts._length; i++) {
        const percuss_v1_ContactResult *x = &a->contacts._buffer[i], *y = &b->contacts._buffer[i];
        REQUIRE(equal(x->impulse, y->impulse) && equal(x->restitution, y->restitution) &&
                    equal(x->end_time, y->end_time) && x->sub_impact_count == y->sub_impact_count,
                "contact %u: impulse %.17g, %.17g", i, x->impulse, y->impulse);
    }
    REQUIRE(a->states_after._length == b->states_after._length, "number of states");
    for (uint32_t i = 0; i < a->states_after._length; i++)
        REQUIRE(strcmp(a->states_after._buffer[i].state, b->states_after._buffer[i].state) == 0,
                "state %u: %s, %s", i, a->states_after._buffer[i].state,
                b->states_after._buffer[i].state);
    REQUIRE(equal(a->energy.closure, b->energy.closure) &&
                equal(a->error.restitution_time, b->error.restitution_time),
            "energy or error");
}

static void repeats(struct peer *peer, struct scene *scene)
{
    scene_fill(scene, 1, 0.3);
    const percuss_v1_Reply *first = ask(peer, scene), *again = ask(peer, scene);
    REQUIRE(first->status == percuss_v1_STATUS_OK, "%s", first->message);
    require_same(first, again);
    REQUIRE(equal(first->timing.solve, again->timing.solve), "the reply was computed anew");
    scene->bodies[0].velocity[2] = -0.4;
    const percuss_v1_Reply *other = ask(peer, scene);
    REQUIRE(other->status == percuss_v1_STATUS_BAD_REQUEST &&
                strstr(other->message, "sequence: 1:"),
            "status %u: %s", other->status, other->message);
    /* under a new number the same question has the same numbers */
    scene_fill(scene, 2, 0.3);
    const percuss_v1_Reply *renamed = ask(peer, scene);
    require_same(first, renamed);
    peer_return(peer, PEER_SINGLE, first);
    peer_return(peer, PEER_SINGLE, again);
    peer_return(peer, PEER_SINGLE, other);
    peer_return(peer, PEER_SINGLE, renamed);
}

static void states(struct peer *peer, struct scene *scene)
{
    scene_fill(scene, 10, 0.3);
    const percuss_v1_Reply *first = ask(peer, scene);
    const char *token = first->states_after._buffer[1].state;
    REQUIRE(strlen(token) == 32, "no token of the beam: \"%s\"", token);
    scene_fill(scene, 11, 0.3);
    snprintf(scene->bodies[1].state, sizeof scene->bodies[1].state, "%s", token);
    scene->bodies[1].elapsed = 1e-3;
    const percuss_v1_Reply *ringing = ask(peer, scene);
    REQUIRE(ringing->status == percuss_v1_STATUS_OK ||
                ringing->status == percuss_v1_STATUS_TRUNCATED,
            "%s", ringing->message);
    REQUIRE(strcmp(ringing->states_after._buffer[1].state, token) != 0, "the state did not change");
    /* a state of the beam is none of the sphere */
    scene_fill(scene, 12, 0.3);
    snprintf(scene->bodies[0].state, sizeof scene->bodies[0].state, "%s", token);
    const percuss_v1_Reply *wrong = ask(peer, scene);
    REQUIRE(wrong->status == percuss_v1_STATUS_UNKNOWN_STATE &&
                strstr(wrong->message, "is a state of al-beam"),
            "status %u: %s", wrong->status, wrong->message);
    peer_return(peer, PEER_SINGLE, first);
    peer_return(peer, PEER_SINGLE, ringing);
    peer_return(peer, PEER_SINGLE, wrong);
}

/* Says how long after the arrival, to three digits. */
static void is_late(const percuss_v1_Reply *reply)
{
    REQUIRE(reply->status == percuss_v1_STATUS_TIMEOUT &&
                strstr(reply->message, "options.deadline: 1e-09") &&
                strstr(reply->message, "s after the arrival"),
            "status %u: %s", reply->status, reply->message);
}

/* Two of them may take the same time to three digits, so many hardly. */
enum { TRIES = 20 };

/* A deadline tells of the moment: whoever asks again is answered anew. */
static void deadlines(struct peer *peer, struct scene *scene)
{
    scene_fill(scene, 20, 0.3);
    scene->request.options.deadline = 1e-9;
    const percuss_v1_Reply *first = ask(peer, scene);
    is_late(first);
    bool anew = false;
    for (int i = 0; i < TRIES && !anew; i++) {
        const percuss_v1_Reply *again = ask(peer, scene);
        is_late(again);
        anew = strcmp(again->message, first->message) != 0;
        peer_return(peer, PEER_SINGLE, again);
    }
    REQUIRE(anew, "kept and given again: %s", first->message);
    peer_return(peer, PEER_SINGLE, first);
    scene_fill(scene, 21, 0.3);
    scene->request.options.deadline = 60.0;
    const percuss_v1_Reply *soon = ask(peer, scene);
    REQUIRE(soon->status == percuss_v1_STATUS_OK, "status %u: %s", soon->status, soon->message);
    peer_return(peer, PEER_SINGLE, soon);
}

/* The same for a batch with a member that is late. */
static void batch_deadlines(struct peer *peer, struct scene *scene)
{
    scene_fill(scene, 22, 0.3);
    scene->request.options.deadline = 1e-9;
    percuss_v1_BatchRequest batch = {
        .sequence = 4, .requests = {._buffer = &scene->request, ._length = 1, ._maximum = 1}};
    char first[1024] = "";
    bool anew = false;
    for (int i = 0; i < TRIES && !anew; i++) {
        peer_send_batch(peer, &batch);
        const percuss_v1_BatchReply *reply = peer_receive(peer, PEER_BATCH, 20.0);
        REQUIRE(reply->replies._length == 1, "status %u: %s", reply->status, reply->message);
        const percuss_v1_Reply *member = &reply->replies._buffer[0];
        is_late(member);
        anew = first[0] && strcmp(first, member->message) != 0;
        snprintf(first, sizeof first, "%s", member->message);
        peer_return(peer, PEER_BATCH, reply);
    }
    REQUIRE(anew, "kept and given again: %s", first);
}

enum { MEMBERS = 256 };

static struct scene members[MEMBERS];

static void send_members(struct peer *peer, uint64_t sequence)
{
    static percuss_v1_Request requests[MEMBERS];
    for (uint64_t i = 0; i < MEMBERS; i++) {
        scene_fill(&members[i], 1000 + i, 0.1 + 1e-3 * (double)i);
        requests[i] = members[i].request;
    }
    percuss_v1_BatchRequest batch = {
        .sequence = sequence,
        .requests = {._buffer = requests, ._length = MEMBERS, ._maximum = MEMBERS}};
    peer_send_batch(peer, &batch);
}

/* The members come in order, in parts that come in order, and say what single requests say. */
static void batches(struct peer *peer)
{
    send_members(peer, 5);
    uint64_t seen = 0;
    uint32_t parts = 1;
    for (uint32_t part = 0; part < parts; part++) {
        const percuss_v1_BatchReply *reply = peer_receive(peer, PEER_BATCH, 20.0);
        REQUIRE(reply->status == percuss_v1_STATUS_OK, "%s", reply->message);
        REQUIRE(reply->part == part, "part %u comes as number %u", reply->part, part);
        parts = reply->parts;
        for (uint32_t i = 0; i < reply->replies._length; i++, seen++) {
            const percuss_v1_Reply *member = &reply->replies._buffer[i];
            REQUIRE(member->sequence == 1000 + seen, "out of order");
            if (seen % 16 > 0)
                continue;
            const percuss_v1_Reply *single = ask(peer, &members[seen]);
            require_same(member, single);
            peer_return(peer, PEER_SINGLE, single);
        }
        peer_return(peer, PEER_BATCH, reply);
    }
    REQUIRE(seen == MEMBERS, "%u members answered", (unsigned)seen);
    send_members(peer, 5);
    for (uint32_t part = 0; part < parts; part++)
        peer_return(peer, PEER_BATCH, peer_receive(peer, PEER_BATCH, 20.0));
    REQUIRE(!peer_hears(peer, PEER_BATCH, 0.1), "parts too many");
    printf("a batch of %d in %u parts\n", MEMBERS, parts);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: wire_exchanges DOMAIN\n");
        return 2;
    }
    struct peer peer;
    struct scene *scene = calloc(1, sizeof *scene);
    peer_open(&peer, (uint32_t)strtoul(argv[1], NULL, 10));
    repeats(&peer, scene);
    states(&peer, scene);
    deadlines(&peer, scene);
    batch_deadlines(&peer, scene);
    batches(&peer);
    peer_close(&peer);
    free(scene);
    puts("repeats, states, deadlines and batches as promised");
    return EXIT_SUCCESS;
}
