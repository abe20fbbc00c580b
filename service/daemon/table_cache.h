/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The daemon's contact tables. Those of the folder, loaded at start, serve `auto` and `table`.
 * Those computed since, because a request insisted on one, serve `table` only, so that the answers
 * to `auto` do not change while the daemon runs; the folder keeps them for the next start. */
#ifndef PERCUSS_DAEMON_TABLE_CACHE_H
#define PERCUSS_DAEMON_TABLE_CACHE_H

#include <stdatomic.h>

#include "endpoint/reply_store.h"
#include "model/body.h"
#include "store/table_store.h"

struct table_cache {
    struct table_store *loaded, *made;
    const char *folder;          /* empty: none */
    struct reply_store *replies; /* knows who is gone */
    const atomic_bool *draining;
    _Atomic double progress; /* of the computation that runs, 0..1; NAN: none */
};

/* Loads the folder; a folder or file that does not do is logged. False: out of memory. */
bool table_cache_load(struct table_cache *cache);
void table_cache_free(struct table_cache *cache);

/* The curves for `table`, or NULL. */
const struct contact_curves *table_cache_find(const struct table_cache *cache,
                                              const struct material *a, const struct material *b);

/* Whether `table` for a request would have to be computed first, as far as its bodies tell. */
bool table_cache_lacks(const struct table_cache *cache, const struct body_set *set,
                       const percuss_v1_Request *request);

/* What `table` is answered from for one request at a time. */
struct table_maker {
    struct contact_table_source source;
    struct table_cache *cache;
    bool makes;                        /* may take its time: the long lane */
    const percuss_v1_Request *request; /* being answered, set by who answers it */
    double arrival;                    /* of it, monotonic, s */
    const uint8_t *client;             /* who asks */
    const atomic_bool *cancelled; /* its client wants no answer any more; NULL: cannot say so */
    enum percuss_status status;   /* why a table could not be had */
    struct fault fault;
};

void table_maker_init(struct table_maker *maker, struct table_cache *cache, bool makes);

/* Begins with a request that asks for `table`, of a client (16 octets; a member of a batch need not
 * name him); what answers it. Tables that are missing are computed, but for materials that
 * `overrides` of the request give: those are nobody else's. */
const struct contact_table_source *table_maker_begin(struct table_maker *maker,
                                                     const percuss_v1_Request *request,
                                                     const uint8_t *client, double arrival);

/* From now on the tables that are there are all: several threads may look them up. */
void table_maker_only_finds(struct table_maker *maker);

#endif
