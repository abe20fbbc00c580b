/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests of one kind: taken from DDS, put in the order of turns, decoded and handed on. Of the
 * thread that runs the endpoint. */
#ifndef PERCUSS_ENDPOINT_INTAKE_H
#define PERCUSS_ENDPOINT_INTAKE_H

#include <stdatomic.h>

#include "endpoint/handler.h"
#include "endpoint/inbox.h"
#include "endpoint/owners.h"
#include "exchange/answer.h"

struct intake {
    enum exchange exchange;
    dds_entity_t reader;
    void *sample;        /* the one at hand; its memory serves the next one */
    struct inbox *inbox; /* of serialised data */
};

/* What decides about a request, and who gets it. */
struct intake_desk {
    const uint8_t *server;  /* this one's id */
    struct owners *owners;  /* of clients' ids */
    atomic_ullong *strange; /* counts those from others than the client whose id they bear */
    const struct endpoint_handler *handler;
};

/* Makes the reader, a child of the participant. False with a fault; intake_close is due all the
 * same, before the participant's end. */
bool intake_open(struct intake *intake, enum exchange exchange, dds_entity_t participant,
                 const char *partition, struct fault *fault);
void intake_close(struct intake *intake);

/* The waitset is woken by new ones, and says the number of the exchange. */
bool intake_attach(const struct intake *intake, dds_entity_t waitset);

/* Takes what is there, up to a bound; true: more may be left. One that comes alone is served at
 * once. */
bool intake_take(struct intake *intake, const struct intake_desk *desk);

/* Serves a few of what was taken; true: some are left. */
bool intake_serve(struct intake *intake, const struct intake_desk *desk);

#endif
