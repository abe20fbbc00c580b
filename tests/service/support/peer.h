/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A client made of the IDL alone, as a program without libpercuss would be: for tests of the wire.
 */
#ifndef PERCUSS_TESTS_PEER_H
#define PERCUSS_TESTS_PEER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "wire.h"

/* The kinds of requests. */
enum peer_topic { PEER_SINGLE, PEER_BATCH, PEER_ENSEMBLE, PEER_TOPICS };

struct peer {
    uint8_t client[16];
    dds_entity_t participant;
    dds_entity_t writers[PEER_TOPICS], readers[PEER_TOPICS], waitsets[PEER_TOPICS];
};

/* Joins the domain and pings until it is answered; ends the program if that takes 20 s. */
void peer_open(struct peer *peer, uint32_t domain);
/* The same with the client id that stands in `peer`. */
void peer_open_as(struct peer *peer, uint32_t domain);
void peer_close(struct peer *peer);

/* Sends; fills in the client. */
void peer_send(struct peer *peer, percuss_v1_Request *request);
void peer_send_batch(struct peer *peer, percuss_v1_BatchRequest *batch);
void peer_send_ensemble(struct peer *peer, percuss_v1_EnsembleRequest *ensemble);

/* The next reply on that topic, to be given back by peer_return; ends the program if there is none
 * for `seconds`. */
const void *peer_receive(struct peer *peer, enum peer_topic topic, double seconds);
void peer_return(struct peer *peer, enum peer_topic topic, const void *reply);

/* Whether a reply comes within `seconds`; it is thrown away. */
bool peer_hears(struct peer *peer, enum peer_topic topic, double seconds);

/* The contract's example: a steel sphere falls on the middle of an aluminium beam. */
struct scene {
    percuss_v1_BodyMotion bodies[64];
    percuss_v1_Contact contacts[64];
    double delassus[4096];
    percuss_v1_Request request;
};
void scene_fill(struct scene *scene, uint64_t sequence, double speed);

/* Monotonic time, s. */
double peer_now(void);

/* Ends the program with a message if `good` is false. */
#define REQUIRE(good, ...)                                                                         \
    do {                                                                                           \
        if (!(good))                                                                               \
            peer_fail(__FILE__, __LINE__, __VA_ARGS__);                                            \
    } while (0)
_Noreturn void peer_fail(const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
