/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact tables for one request at a time: those that are there, and those that are computed
 * because it insists on them. */
#ifndef PERCUSS_RESPOND_TABLE_MAKER_H
#define PERCUSS_RESPOND_TABLE_MAKER_H

#include "percuss_wire.h"
#include "respond/table_cache.h"

struct table_maker;

/* The wait for a table that is computed, which takes seconds to minutes. */
struct table_wait {
    /* OK as long as the table is wanted; else the reason; `done`: its computed share, 0 .. 1 */
    enum percuss_status (*goes_on)(void *context, const struct table_maker *maker, double done,
                                   struct fault *fault);
    /* no table is computed any more; may be NULL */
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
    double arrival, begun;      /* of it, and of the work for it; monotonic, s */
    const uint8_t *client;      /* the client that asks */
    enum percuss_status status; /* why a table could not be had */
    struct fault fault;
    /* the wait for the request, as for a solve (struct question); NULL: `wait` alone counts */
    enum percuss_status (*still_wanted)(void *context, struct fault *fault);
    void *wanted_context; /* of that */
    _Atomic double *done; /* receives the share of a table that is computed; may be NULL */
};

void table_maker_init(struct table_maker *maker, const struct table_wait *wait, double limit);

/* Begins with a request of a client (16 octets; a member of a batch need not name it) and returns
 * its tables. A request that leaves the choice of the contact model takes the tables that were
 * there at the start; one that insists on `table` has missing ones computed, except for materials
 * that its `overrides` give: no other request has those. */
const struct contact_table_source *table_maker_begin(struct table_maker *maker,
                                                     struct table_cache *cache,
                                                     const percuss_v1_Request *request,
                                                     const uint8_t *client, double arrival);

/* From now on no table is computed: several threads may look tables up. */
void table_maker_only_finds(struct table_maker *maker);

#endif
