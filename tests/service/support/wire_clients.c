/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Many clients at once: every request is answered once, to the client that asked, with its own
 * numbers. With `latency`: round trips of one client. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer.h"

enum { CLIENTS = 8, REQUESTS = 1000, WINDOW = 32, TRIPS = 5000 };

struct load {
    uint32_t domain;
    unsigned index;
    unsigned busy;
};

/* A speed that no other request of any client has. */
static double speed_of(unsigned client, uint64_t sequence)
{
    return 0.1 + 1e-3 * client + 1e-6 * (double)sequence;
}

/* The server computes 1/m and m v: their product tells whose question it answered. */
static void check_reply(const struct peer *peer, const percuss_v1_Reply *reply, double speed)
{
    REQUIRE(memcmp(reply->client, peer->client, sizeof reply->client) == 0,
            "a reply for somebody else");
    REQUIRE(reply->status == percuss_v1_STATUS_OK, "sequence %llu: status %u: %s",
            (unsigned long long)reply->sequence, reply->status, reply->message);
    REQUIRE(reply->contacts._length == 1, "one contact asked, %u answered",
            reply->contacts._length);
    const percuss_v1_ContactResult *contact = &reply->contacts._buffer[0];
    double told = contact->impulse_compression * contact->inverse_effective_mass;
    REQUIRE(fabs(told - speed) < 1e-9 * speed, "asked at %.12g m/s, answered at %.12g", speed,
            told);
}

static void send_numbered(struct peer *peer, struct scene *scene, unsigned client,
                          uint64_t sequence)
{
    scene_fill(scene, sequence, speed_of(client, sequence));
    peer_send(peer, &scene->request);
}

static void *ask_many(void *argument)
{
    struct load *load = argument;
    struct peer peer;
    struct scene *scene = calloc(1, sizeof *scene);
    bool answered[REQUESTS + 1] = {false};
    peer_open(&peer, load->domain);
    uint64_t sent = 0;
    for (unsigned done = 0; done < REQUESTS;) {
        for (; sent < REQUESTS && sent - done < WINDOW; sent++)
            send_numbered(&peer, scene, load->index, sent + 1);
        const percuss_v1_Reply *reply = peer_receive(&peer, PEER_SINGLE, 20.0);
        uint64_t sequence = reply->sequence;
        REQUIRE(sequence >= 1 && sequence <= sent && !answered[sequence],
                "sequence %llu: never sent, or answered before", (unsigned long long)sequence);
        if (reply->status == percuss_v1_STATUS_BUSY) {
            load->busy++;
            dds_sleepfor(DDS_MSECS(1));
            send_numbered(&peer, scene, load->index, sequence);
        } else {
            check_reply(&peer, reply, speed_of(load->index, sequence));
            answered[sequence] = true;
            done++;
        }
        peer_return(&peer, PEER_SINGLE, reply);
    }
    REQUIRE(!peer_hears(&peer, PEER_SINGLE, 0.2), "a reply too many");
    peer_close(&peer);
    free(scene);
    return NULL;
}

static void run_clients(uint32_t domain)
{
    pthread_t threads[CLIENTS];
    struct load loads[CLIENTS];
    unsigned busy = 0;
    double start = peer_now();
    for (unsigned i = 0; i < CLIENTS; i++) {
        loads[i] = (struct load){.domain = domain, .index = i};
        REQUIRE(!pthread_create(&threads[i], NULL, ask_many, &loads[i]), "no thread");
    }
    for (unsigned i = 0; i < CLIENTS; i++) {
        pthread_join(threads[i], NULL);
        busy += loads[i].busy;
    }
    printf("%d requests of each of %d clients answered, %u asked again, %.2f s\n", REQUESTS,
           CLIENTS, busy, peer_now() - start);
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void measure(struct peer *peer, struct scene *scene, const char *what, uint64_t first)
{
    static double times[TRIPS];
    for (unsigned i = 0; i < TRIPS; i++) {
        scene_fill(scene, first ? first + i : 0, 0.1 + 1e-6 * i);
        double start = peer_now();
        peer_send(peer, &scene->request);
        peer_return(peer, PEER_SINGLE, peer_receive(peer, PEER_SINGLE, 5.0));
        times[i] = peer_now() - start;
    }
    qsort(times, TRIPS, sizeof *times, by_size);
    printf("%s: p50 %.1f us, p99 %.1f us\n", what, 1e6 * times[TRIPS / 2],
           1e6 * times[TRIPS * 99 / 100]);
}

static void run_latency(uint32_t domain)
{
    struct peer peer;
    struct scene *scene = calloc(1, sizeof *scene);
    peer_open(&peer, domain);
    measure(&peer, scene, "ping", 0);
    measure(&peer, scene, "query", 1);
    peer_close(&peer);
    free(scene);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: wire_clients DOMAIN [latency]\n");
        return 2;
    }
    uint32_t domain = (uint32_t)strtoul(argv[1], NULL, 10);
    if (argc > 2)
        run_latency(domain);
    else
        run_clients(domain);
    return EXIT_SUCCESS;
}
