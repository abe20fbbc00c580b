/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/table_maker.h"

#include <time.h>

#include "contact/law_closed_form.h"
#include "exchange/clock.h"
#include "fe/indentation.h"
#include "store/table_key.h"

/* How deep tables made here go: fixed, so that the table does not depend on the first request. */
static const double COVERED_SPEED = 1.0;

/* Pause between two looks for its turn: short against the time that a table takes. */
static const long TURN_NANOSECONDS = 20000000;

/* Called by the computation; false stops it. */
static bool go_on(void *context, double done)
{
    struct table_maker *maker = context;
    double deadline = maker->request->options.deadline;
    if (maker->done)
        atomic_store(maker->done, done);
    maker->status = maker->wait.goes_on(maker->wait.context, maker, done, &maker->fault);
    if (!maker->status && maker->still_wanted)
        maker->status = maker->still_wanted(maker->wanted_context, &maker->fault);
    if (maker->status)
        return false;
    if (clock_now() - maker->begun > maker->limit)
        maker->status = fault_set(
            &maker->fault, PERCUSS_TIMEOUT,
            "limits.seconds: %g: the server's time for one request had passed with %.0f %% of the "
            "contact table computed: compute it ahead by percuss-tables",
            maker->limit, 100.0 * done);
    else if (deadline > 0.0 && clock_now() - maker->arrival > deadline)
        maker->status = fault_set(
            &maker->fault, PERCUSS_TIMEOUT,
            "options.deadline: %g: had passed with %.0f %% of the contact table computed: "
            "allow more time, or compute it ahead by percuss-tables",
            deadline, 100.0 * done);
    return maker->status == PERCUSS_OK;
}

static double thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Waits until no other thread computes a table, which may be the same one. False: this one is not
 * wanted any more. */
static bool await_turn(struct table_maker *maker)
{
    while (atomic_exchange(&maker->cache->making, true)) {
        if (!go_on(maker, 0.0))
            return false;
        nanosleep(&(struct timespec){.tv_nsec = TURN_NANOSECONDS}, NULL);
    }
    return true;
}

static const struct contact_curves *make(struct table_maker *maker, const struct material *a,
                                         const struct material *b)
{
    struct region_input input = table_input(a, b, COVERED_SPEED);
    /* the table, as long as it is wanted */
    struct watch watch = {go_on, maker};
    struct indentation_table table;
    struct fault fault;
    double start = thread_seconds();
    enum percuss_status status = indentation_table_make(&input, &watch, &table, &fault);
    if (maker->wait.ended)
        maker->wait.ended(maker->wait.context, maker);
    /* for all requests from now on */
    if (!status) {
        status = table_cache_add(maker->cache, &table, thread_seconds() - start, &fault);
        indentation_table_free(&table);
    }
    /* it was not given up, so it failed */
    if (status && !maker->status)
        maker->status = fault_set(&maker->fault, PERCUSS_INTERNAL,
                                  "the contact table of %s on %s could not be computed: %.300s",
                                  a->name, b->name, fault.text);
    return status ? NULL : table_cache_find(maker->cache, a, b);
}

static const struct contact_curves *find_or_make(void *context, const struct contact_pair *pair)
{
    struct table_maker *maker = context;
    const struct material *a = pair->a, *b = pair->b;
    if (!table_store_is_circular(pair->curvature) || closed_form_softer(a, b) < 0)
        return NULL;
    const struct contact_curves *curves = table_cache_find(maker->cache, a, b);
    if (curves || maker->status)
        return curves;
    if (maker->wait.goes_on) {
        if (!await_turn(maker))
            return NULL;
        curves = table_cache_find(maker->cache, a, b);
        if (!curves)
            curves = make(maker, a, b);
        atomic_store(&maker->cache->making, false);
        return curves;
    }
    /* the catalogue was reloaded while the request was on its way here */
    maker->status =
        fault_set(&maker->fault, PERCUSS_BUSY, "the contact table is not computed yet: ask again");
    return NULL;
}

static const struct contact_curves *find_only(void *context, const struct contact_pair *pair)
{
    const struct table_maker *maker = context;
    return table_store_is_circular(pair->curvature)
               ? table_cache_find(maker->cache, pair->a, pair->b)
               : NULL;
}

static bool overrides_material(const percuss_v1_Request *request)
{
    for (size_t b = 0; b < request->bodies._length; b++) {
        const percuss_v1_BodyMotion *body = &request->bodies._buffer[b];
        for (size_t i = 0; i < body->overrides._length; i++) {
            unsigned parameter = body->overrides._buffer[i].parameter;
            if (parameter == PERCUSS_PARAMETER_YOUNG || parameter == PERCUSS_PARAMETER_POISSON ||
                parameter == PERCUSS_PARAMETER_YIELD || parameter == PERCUSS_PARAMETER_TANGENT)
                return true;
        }
    }
    return false;
}

void table_maker_init(struct table_maker *maker, const struct table_wait *wait, double limit)
{
    *maker = (struct table_maker){.source.context = maker, .wait = *wait, .limit = limit};
}

const struct contact_table_source *table_maker_begin(struct table_maker *maker,
                                                     struct table_cache *cache,
                                                     const percuss_v1_Request *request,
                                                     const uint8_t *client, double arrival)
{
    maker->cache = cache;
    maker->request = request;
    maker->arrival = arrival;
    maker->begun = clock_now();
    maker->client = client;
    maker->status = PERCUSS_OK;
    maker->source.find = overrides_material(request) ? find_only : find_or_make;
    return contact_law_asked(request->options.contact_model)->tables == CONTACT_TABLES_ONLY
               ? &maker->source
               : table_store_source(cache->loaded);
}

void table_maker_only_finds(struct table_maker *maker)
{
    maker->source.find = find_only;
}
