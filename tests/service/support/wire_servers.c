/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests that name a server: the one that is named answers, every other ignores them silently. On
 * each topic a request to nobody's id goes first, then one to the server's own; the first reply
 * must be to the second. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

enum { TO_ANOTHER = 1, TO_IT = 2 };
static const double patience = 20.0; /* s */

/* Who answered the ping of peer_open, and an id that is nobody's. */
struct names {
    uint8_t it[16], another[16];
};

static struct names find_names(struct peer *peer)
{
    struct names names;
    percuss_v1_Request ping = {.sequence = 0};
    peer_send(peer, &ping);
    const percuss_v1_Reply *reply = peer_receive(peer, PEER_SINGLE, patience);
    memcpy(names.it, reply->server, sizeof names.it);
    memcpy(names.another, reply->server, sizeof names.another);
    names.another[15] ^= 1;
    peer_return(peer, PEER_SINGLE, reply);
    return names;
}

static void require_it(uint64_t sequence, const char *topic)
{
    REQUIRE(sequence == TO_IT, "%s: a server answered a request to another one", topic);
}

static void ask_single(struct peer *peer, const struct names *names, struct scene *scene)
{
    scene_fill(scene, TO_ANOTHER, 0.3);
    memcpy(scene->request.server, names->another, sizeof names->another);
    peer_send(peer, &scene->request);
    scene_fill(scene, TO_IT, 0.3);
    memcpy(scene->request.server, names->it, sizeof names->it);
    peer_send(peer, &scene->request);
    const percuss_v1_Reply *reply = peer_receive(peer, PEER_SINGLE, patience);
    require_it(reply->sequence, "Request");
    peer_return(peer, PEER_SINGLE, reply);
}

static void ask_batch(struct peer *peer, const struct names *names, struct scene *scene)
{
    scene_fill(scene, TO_IT, 0.3);
    percuss_v1_BatchRequest batch = {
        .sequence = TO_ANOTHER,
        .requests = {._buffer = &scene->request, ._length = 1, ._maximum = 1},
    };
    memcpy(batch.server, names->another, sizeof names->another);
    peer_send_batch(peer, &batch);
    batch.sequence = TO_IT;
    memcpy(batch.server, names->it, sizeof names->it);
    peer_send_batch(peer, &batch);
    const percuss_v1_BatchReply *reply = peer_receive(peer, PEER_BATCH, patience);
    require_it(reply->sequence, "BatchRequest");
    peer_return(peer, PEER_BATCH, reply);
}

/* Without inputs it is refused, which is an answer. */
static void ask_ensemble(struct peer *peer, const struct names *names, struct scene *scene)
{
    scene_fill(scene, TO_IT, 0.3);
    percuss_v1_EnsembleRequest ensemble = {
        .sequence = TO_ANOTHER, .scene = scene->request, .samples = 1};
    memcpy(ensemble.server, names->another, sizeof names->another);
    peer_send_ensemble(peer, &ensemble);
    ensemble.sequence = TO_IT;
    memcpy(ensemble.server, names->it, sizeof names->it);
    peer_send_ensemble(peer, &ensemble);
    const percuss_v1_EnsembleReply *reply = peer_receive(peer, PEER_ENSEMBLE, patience);
    require_it(reply->sequence, "EnsembleRequest");
    peer_return(peer, PEER_ENSEMBLE, reply);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: wire_servers DOMAIN\n");
        return 2;
    }
    static struct peer peer;
    struct scene *scene = calloc(1, sizeof *scene);
    peer_open(&peer, (uint32_t)strtoul(argv[1], NULL, 10));
    struct names names = find_names(&peer);
    ask_single(&peer, &names, scene);
    ask_batch(&peer, &names, scene);
    ask_ensemble(&peer, &names, scene);
    peer_close(&peer);
    free(scene);
    puts("who is named answers");
    return EXIT_SUCCESS;
}
