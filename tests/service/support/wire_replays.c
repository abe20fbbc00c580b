/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Event location replays time: the same questions come again, late, twice at once, out of order,
 * after thousands of others. A request of the last 1024 of its client has the same bytes every
 * time, and one that was forgotten the same numbers; states stay what they were. */
#include <dds/ddsi/ddsi_serdata.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

enum { OTHERS = 3000, OWN = 1000, WINDOW = 64, TRIALS = 40, REPLAYS = 400 };

/* A reply as it came over the wire, and what it says. */
struct raw {
    size_t size;
    unsigned char *bytes;
    percuss_v1_Reply reply;
};

static struct raw receive_raw(struct peer *peer)
{
    struct raw raw = {0};
    struct ddsi_serdata *data = NULL;
    dds_sample_info_t info;
    double end = peer_now() + 20.0;
    while (dds_takecdr(peer->readers[PEER_SINGLE], &data, 1, &info, DDS_ANY_STATE) < 1) {
        REQUIRE(peer_now() < end, "no reply within 20 s");
        dds_waitset_wait(peer->waitsets[PEER_SINGLE], NULL, 0, DDS_MSECS(100));
    }
    REQUIRE(info.valid_data, "the server is gone");
    raw.size = ddsi_serdata_size(data);
    raw.bytes = malloc(raw.size);
    REQUIRE(raw.bytes, "no memory");
    ddsi_serdata_to_ser(data, 0, raw.size, raw.bytes);
    REQUIRE(ddsi_serdata_to_sample(data, &raw.reply, NULL, NULL), "not a reply");
    ddsi_serdata_unref(data);
    return raw;
}

static void free_raw(struct raw *raw)
{
    free(raw->bytes);
    dds_sample_free(&raw->reply, &percuss_v1_Reply_desc, DDS_FREE_CONTENTS);
}

static void require_same_bytes(const struct raw *a, const struct raw *b)
{
    REQUIRE(a->size == b->size && memcmp(a->bytes, b->bytes, a->size) == 0,
            "sequence %llu: other bytes", (unsigned long long)a->reply.sequence);
}

static struct raw ask(struct peer *peer, struct scene *scene)
{
    peer_send(peer, &scene->request);
    return receive_raw(peer);
}

/* `count` questions of one client, answered or not yet. */
static void ask_many(struct peer *peer, struct scene *scene, uint64_t first, unsigned count)
{
    unsigned sent = 0;
    for (unsigned done = 0; done < count; done++) {
        for (; sent < count && sent - done < WINDOW; sent++) {
            /* a sphere that comes slowly: one short impact */
            scene_fill(scene, first + sent, 0.05 + 1e-6 * sent);
            peer_send(peer, &scene->request);
        }
        struct raw raw = receive_raw(peer);
        REQUIRE(raw.reply.status == percuss_v1_STATUS_OK, "%s", raw.reply.message);
        free_raw(&raw);
    }
}

/* The same bytes after thousands of others; outside the window the same numbers. */
static void remembers(struct peer *peer, struct peer *stranger, struct scene *scene)
{
    scene_fill(scene, 1, 0.3);
    struct raw first = ask(peer, scene);
    ask_many(stranger, scene, 1, OTHERS);
    ask_many(peer, scene, 2, OWN);
    scene_fill(scene, 1, 0.3);
    struct raw again = ask(peer, scene);
    require_same_bytes(&first, &again);
    free_raw(&again);
    ask_many(peer, scene, 2 + OWN, OWN);
    scene_fill(scene, 1, 0.3);
    again = ask(peer, scene);
    const percuss_v1_ContactResult *x = &first.reply.contacts._buffer[0];
    const percuss_v1_ContactResult *y = &again.reply.contacts._buffer[0];
    REQUIRE(memcmp(&x->impulse, &y->impulse, sizeof x->impulse) == 0 &&
                memcmp(x->sub_impacts._buffer, y->sub_impacts._buffer,
                       x->sub_impacts._length * sizeof *x->sub_impacts._buffer) == 0 &&
                strcmp(first.reply.states_after._buffer[1].state,
                       again.reply.states_after._buffer[1].state) == 0,
            "other numbers after the reply was forgotten");
    free_raw(&first);
    free_raw(&again);
}

/* Trial `number` of an event location: a little later every time, on a beam that rings. */
static void fill_trial(struct scene *scene, unsigned number, const char *state)
{
    scene_fill(scene, 10000 + number, 0.2 + 1e-4 * number);
    snprintf(scene->bodies[1].state, sizeof scene->bodies[1].state, "%s", state);
    scene->bodies[1].elapsed = 1e-3 + 1e-5 * number;
    scene->contacts[0].gap = 1e-6 * number;
}

/* Compares a reply with the first one of its number, or keeps it as that. */
static void check(struct raw *known, struct raw raw)
{
    uint64_t number = raw.reply.sequence - 10000;
    REQUIRE(number < TRIALS && raw.reply.status == percuss_v1_STATUS_OK, "%s", raw.reply.message);
    if (!known[number].size) {
        known[number] = raw;
        return;
    }
    require_same_bytes(&known[number], &raw);
    free_raw(&raw);
}

/* Trials in any order, again and again, four different ones at once; then the same one many times
 * at once, of which those that find it being answered share its one reply. */
static void replays(struct peer *peer, struct scene *scene)
{
    static struct raw known[TRIALS];
    char state[64];
    scene_fill(scene, 9999, 0.3);
    struct raw before = ask(peer, scene);
    snprintf(state, sizeof state, "%s", before.reply.states_after._buffer[1].state);
    uint64_t seed = 1;
    for (unsigned i = 0; i < REPLAYS; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        unsigned start = (unsigned)(seed >> 33) % TRIALS;
        for (unsigned k = 4; k-- > 0;) {
            fill_trial(scene, (start + k) % TRIALS, state);
            peer_send(peer, &scene->request);
        }
        for (unsigned k = 0; k < 4; k++)
            check(known, receive_raw(peer));
    }
    scene_fill(scene, 9998, 0.25);
    for (unsigned i = 0; i < WINDOW; i++)
        peer_send(peer, &scene->request);
    struct raw one = receive_raw(peer);
    struct raw other = ask(peer, scene);
    require_same_bytes(&one, &other);
    unsigned further = 0;
    while (peer_hears(peer, PEER_SINGLE, 0.2))
        further++;
    REQUIRE(further < WINDOW, "%u replies to %u questions", further + 2, WINDOW + 1);
    for (unsigned number = 0; number < TRIALS; number++) {
        REQUIRE(known[number].size, "trial %u was never asked", number);
        free_raw(&known[number]);
    }
    free_raw(&one);
    free_raw(&other);
    free_raw(&before);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: wire_replays DOMAIN\n");
        return 2;
    }
    static struct peer peer, stranger;
    struct scene *scene = calloc(1, sizeof *scene);
    uint32_t domain = (uint32_t)strtoul(argv[1], NULL, 10);
    peer_open(&peer, domain);
    peer_open(&stranger, domain);
    remembers(&peer, &stranger, scene);
    replays(&peer, scene);
    peer_close(&peer);
    peer_close(&stranger);
    free(scene);
    puts("the same bytes every time");
    return EXIT_SUCCESS;
}
