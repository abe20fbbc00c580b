/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/table_cache.h"

#include <math.h>
#include <time.h>

#include "contact/law_closed_form.h"
#include "daemon/log.h"
#include "endpoint/clock.h"
#include "store/table_file.h"
#include "store/table_key.h"

/* How deep tables made here go: fixed, so that the table does not depend on who asks first. */
static const double covered_speed = 1.0;

static void complain(const struct fault *fault)
{
    log_line(LEVEL_WARNING, "table left out: %s", fault->text);
}

bool table_cache_load(struct table_cache *cache)
{
    size_t count;
    struct fault fault;
    atomic_init(&cache->progress, NAN);
    cache->loaded = table_store_create();
    cache->made = table_store_create();
    if (!cache->loaded || !cache->made)
        return false;
    if (!*cache->folder)
        return true;
    if (table_store_load(cache->loaded, cache->folder, complain, &count, &fault))
        log_line(LEVEL_WARNING, "tables: %s", fault.text);
    else
        log_line(LEVEL_INFO, "tables: %zu from %s%s", count, cache->folder,
                 table_store_source(cache->loaded)->family
                     ? " and the family for all other metals"
                     : "; no family there: other metals yield by the closed form");
    table_store_lend_family(cache->made, cache->loaded);
    return true;
}

void table_cache_free(struct table_cache *cache)
{
    table_store_free(cache->loaded);
    table_store_free(cache->made);
}

const struct contact_curves *table_cache_find(const struct table_cache *cache,
                                              const struct material *a, const struct material *b)
{
    const struct contact_curves *curves = table_store_find(cache->loaded, a, b);
    return curves ? curves : table_store_find(cache->made, a, b);
}

bool table_cache_lacks(const struct table_cache *cache, const struct body_set *set,
                       const percuss_v1_Request *request)
{
    size_t bodies = request->bodies._length;
    if (request->options.contact_model != PERCUSS_CONTACT_TABLE)
        return false;
    for (size_t i = 0; i < request->contacts._length; i++) {
        const percuss_v1_Contact *contact = &request->contacts._buffer[i];
        if (contact->a >= bodies || contact->b >= bodies)
            continue;
        const struct body *a = body_set_find(set, request->bodies._buffer[contact->a].id);
        const struct body *b = body_set_find(set, request->bodies._buffer[contact->b].id);
        if (a && b && closed_form_softer(&a->material, &b->material) >= 0 &&
            !table_cache_find(cache, &a->material, &b->material))
            return true;
    }
    return false;
}

/* Asked by the computation; false stops it. */
static bool go_on(void *context, double done)
{
    struct table_maker *maker = context;
    double deadline = maker->request->options.deadline;
    atomic_store(&maker->cache->progress, done);
    if (atomic_load(maker->cache->draining))
        maker->status =
            fault_set(&maker->fault, PERCUSS_BUSY, "the server is shutting down: ask another one");
    else if (maker->cancelled && atomic_load(maker->cancelled))
        maker->status =
            fault_set(&maker->fault, PERCUSS_TIMEOUT,
                      "cancelled with %.0f %% of the contact table computed", 100.0 * done);
    else if (reply_store_is_gone(maker->cache->replies, maker->client))
        maker->status = fault_set(&maker->fault, PERCUSS_TIMEOUT, "the client had gone: ask again");
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

static void keep(const struct table_cache *cache, const struct indentation_table *table,
                 double seconds)
{
    char path[TABLE_PATH_SIZE];
    struct fault fault;
    struct table_origin origin = {"percussd " PERCUSS_VERSION, seconds};
    const char *a = table->input.materials[0].name, *b = table->input.materials[1].name;
    log_line(LEVEL_INFO, "table of %s on %s: computed in %.1f s", a, b, seconds);
    if (*cache->folder && table_file_save(cache->folder, table, &origin, path, &fault))
        log_line(LEVEL_WARNING, "table of %s on %s: kept until the end only: %s", a, b, fault.text);
}

static const struct contact_curves *make(struct table_maker *maker, const struct material *a,
                                         const struct material *b)
{
    struct table_cache *cache = maker->cache;
    struct region_input input = table_input(a, b, covered_speed);
    struct indentation_progress progress = {go_on, maker};
    struct indentation_table table;
    struct fault fault;
    double start = thread_seconds();
    enum percuss_status status = indentation_table_make(&input, &progress, &table, &fault);
    atomic_store(&cache->progress, NAN);
    if (!status) {
        status = table_store_add(cache->made, &table, &fault);
        keep(cache, &table, thread_seconds() - start);
        indentation_table_free(&table);
    }
    if (status && !maker->status)
        maker->status = fault_set(&maker->fault, PERCUSS_INTERNAL,
                                  "the contact table of %s on %s could not be computed: %.300s",
                                  a->name, b->name, fault.text);
    return status ? NULL : table_store_find(cache->made, a, b);
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
    if (maker->makes)
        return make(maker, a, b);
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

void table_maker_init(struct table_maker *maker, struct table_cache *cache, bool makes)
{
    *maker = (struct table_maker){.source.context = maker, .cache = cache, .makes = makes};
}

const struct contact_table_source *table_maker_begin(struct table_maker *maker,
                                                     const percuss_v1_Request *request,
                                                     const uint8_t *client, double arrival)
{
    maker->request = request;
    maker->arrival = arrival;
    maker->client = client;
    maker->cancelled = NULL;
    maker->status = PERCUSS_OK;
    maker->source.find = overrides_material(request) ? find_only : find_or_make;
    return &maker->source;
}

void table_maker_only_finds(struct table_maker *maker)
{
    maker->source.find = find_only;
}
