/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What members of a crowd share: their service, and how long. */
#ifndef PERCUSS_CROWD_H
#define PERCUSS_CROWD_H

#include <stdbool.h>

#include "questions.h"

struct crowd {
    uint32_t domain;
    enum question_kind kind;
    double seconds;         /* how long */
    unsigned clients;       /* that ask side by side, each in a thread of its own */
    unsigned outstanding;   /* requests of each of them */
    unsigned long requests; /* of each of them, where they are counted */
    unsigned long samples;  /* of an ensemble */
    unsigned specimens;     /* of all clients, hit in turn; 0: no strikes */
    const char *record;     /* file for what was answered; NULL: none */
};

/* A connected client; NULL after a message. `id` NULL: a random one. */
struct percuss_client *crowd_connect(const struct crowd *crowd, const uint8_t *id);

/* Monotonic time, s. */
double crowd_now(void);

/* What a crowd does; each prints what it found and returns whether all was well. */
bool crowd_probe(const struct crowd *crowd);  /* one client, one question after the other */
bool crowd_flood(const struct crowd *crowd);  /* as many as are allowed, whatever the answers */
bool crowd_steady(const struct crowd *crowd); /* each request answered once, whatever happens */
bool crowd_pass(const struct crowd *crowd);   /* clients that come, ask once and vanish */

#endif
