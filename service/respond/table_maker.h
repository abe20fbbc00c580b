/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact tables for one request at a time: those that are there, and those that are computed
 * because it insists on them. */
#ifndef PERCUSS_RESPOND_TABLE_MAKER_H
#define PERCUSS_RESPOND_TABLE_MAKER_H

#include "percuss_wire.h"
#include "respond/table_cache.h"

struct table_maker;

/* Whoever waits for a table that is computed, which takes seconds to minutes. */
struct table_wait {
    /* OK as long as it is wanted, of which the share `done` (0 .. 1) is computed; else why not */
    enum percuss_status (*goes_on)(void *context, const struct table_maker *maker, double done,
                                   struct fault *fault);
    /* no table is computed any more; NULL: nobody wants to know */
    void (*ended)(void *context, const struct table_maker *maker);
    void *context;
};

/* Of one thread, unless it only finds. */
struct table_maker {
    struct contact_table_source source;
    struct table_wait wait;    /* without goes_on no tables are computed */
    double limit;              /* of the time for one request, s */
    struct table_cache *cache; /* of the request at hand, as all below */
    const percuss_v1_Request *request;
    double arrival, begun;      /* of it, and of what is done for it; monotonic, s */
    const uint8_t *client;      /* who asks */
    enum percuss_status status; /* why a table could not be had */
    struct fault fault;
    /* who waits for the request, as for a solve (struct question); NULL: nobody but `wait` */
    enum percuss_status (*still_wanted)(void *context, struct fault *fault);
    void *wanted_context; /* of that */
    _Atomic double *done; /* is told which share of a table is computed; NULL: nobody looks */
};

void table_maker_init(struct table_maker *maker, const struct table_wait *wait, double limit);

/* Begins with a request of a client (16 octets; a member of a batch need not name him): what
 * answers it. Who leaves the choice of the contact model takes the tables that were there at the
 * start; who insists on `table` has missing ones computed, but for materials that `overrides` of
 * the request give: those are nobody else's. */
const struct contact_table_source *table_maker_begin(struct table_maker *maker,
                                                     struct table_cache *cache,
                                                     const percuss_v1_Request *request,
                                                     const uint8_t *client, double arrival);

/* From now on the tables that are there are all: several threads may look them up. */
void table_maker_only_finds(struct table_maker *maker);

#endif
