/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/check_config.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/catalogue.h"
#include "daemon/identity.h"
#include "daemon/limits.h"
#include "daemon/reducer.h"
#include "daemon/standby.h"
#include "endpoint/endpoint.h"
#include "model/body_kind.h"
#include "percuss/plausible.h"
#include "respond/table_cache.h"
#include "store/database.h"
#include "store/database_check.h"
#include "wire.h"
#include "wire_security.h"

static void say(const struct fault *fault)
{
    fprintf(stderr, "percussd: %s\n", fault->text);
}

/* Remarks on sites of meshes that were not declared on the surface. */
static void remark_sites(const struct body_set *set)
{
    for (size_t b = 0; b < set->count; b++)
        for (size_t i = 0; i < set->bodies[b].site_count; i++) {
            const struct body *body = &set->bodies[b];
            const struct body_site *site = &body->sites[i];
            if (site->moved > 0.0)
                fprintf(stderr,
                        "percussd: bodies.%s.sites.%s.point: lies %.2g m off the surface: moved "
                        "onto it, to [%.6g, %.6g, %.6g]\n",
                        body->id, site->name, body->scale * site->moved, site->point[0],
                        site->point[1], site->point[2]);
        }
}

/* A material is remarked once, under the first body that is of it. */
static bool is_first_of_its_material(const struct body_set *set, size_t number)
{
    size_t b = 0;
    while (strcmp(set->bodies[b].material.name, set->bodies[number].material.name) != 0)
        b++;
    return b == number;
}

/* Warns of numbers that are possible but improbable. */
static void remark_numbers(const struct body_set *set)
{
    struct plausible_remark remarks[PLAUSIBLE_MOST];
    for (size_t b = 0; b < set->count; b++) {
        const struct body *body = &set->bodies[b];
        struct body_description description = {.text = ""};
        body->kind->describe(body, &description);
        const struct plausible_body numbers = {
            body->kind->name, body_parameter(body, PERCUSS_PARAMETER_YOUNG),
            body_parameter(body, PERCUSS_PARAMETER_DENSITY),
            body_parameter(body, PERCUSS_PARAMETER_YIELD), description.half_extents};
        bool first = is_first_of_its_material(set, b);
        size_t count = first ? plausible_material(&numbers, remarks) : 0;
        for (size_t i = 0; i < count; i++)
            fprintf(stderr, "percussd: warning: materials.%s.%s: %s\n", body->material.name,
                    remarks[i].key, remarks[i].text);
        if (first && plausible_unstated(&numbers, !body->yield_unstated, remarks))
            fprintf(stderr, "percussd: materials.%s.%s: %s\n", body->material.name, remarks->key,
                    remarks->text);
        bool stated = !isnan(body->loss_factor) || body->relaxation.count > 0;
        if (first && plausible_lossless(&numbers, stated, remarks))
            fprintf(stderr, "percussd: materials.%s.%s: %s\n", body->material.name, remarks->key,
                    remarks->text);
        count = plausible_size(&numbers, remarks);
        for (size_t i = 0; i < count; i++)
            fprintf(stderr, "percussd: warning: bodies.%s.%s: %s\n", body->id, remarks[i].key,
                    remarks[i].text);
    }
}

/* Names the bodies that are missing, or will be reduced. */
static bool check_catalogue(const struct settings *settings)
{
    struct fault fault;
    struct body_set *set;
    const char *folder = settings->bodies[0] ? settings->bodies : NULL;
    if (catalogue_load_reducing(settings->catalogue, folder, &set, &fault)) {
        say(&fault);
        return false;
    }
    remark_sites(set);
    remark_numbers(set);
    bool whole = true;
    for (size_t i = 0; i < set->order_count; i++) {
        const struct body_order *order = &set->orders[i];
        whole = whole && !order->missing;
        if (order->missing)
            fprintf(stderr, "percussd: %s: %s\n", order->id, body_order_news(order).text);
        else if (!order->made)
            printf("%s: will be reduced from %s\n", order->id, order->mesh);
    }
    body_set_free(set);
    return whole;
}

/* Reads every table; one that is damaged, which a daemon leaves out, is remarked. */
static bool check_tables(const struct settings *settings)
{
    struct fault fault;
    size_t count;
    struct table_store *store = table_store_create();
    struct table_folders *folders = malloc(sizeof *folders);
    bool good = store && folders;
    if (folders)
        table_folders_find(folders, settings);
    for (size_t i = 0; store && folders && i < folders->count; i++) {
        table_store_load_family(store, folders->each[i], say);
        if (table_store_load(store, folders->each[i], say, &count, &fault)) {
            fprintf(stderr, "percussd: tables: %s\n", fault.text);
            good = false;
        }
    }
    if (!store || !folders)
        fprintf(stderr, "percussd: tables: out of memory\n");
    free(folders);
    table_store_free(store);
    return good;
}

static bool check_bodies(const struct settings *settings)
{
    struct fault fault;
    if (!settings->bodies[0] || !reducer_check_folder(settings->bodies, &fault))
        return true;
    fprintf(stderr, "percussd: bodies: %s\n", fault.text);
    return false;
}

static bool check_store(const struct settings *settings)
{
    struct fault fault;
    char remark[256];
    if (!settings->store[0])
        return true;
    if (database_remark_volume(settings->store, remark, sizeof remark))
        fprintf(stderr, "percussd: warning: store: %s: %s\n", settings->store, remark);
    if (database_room_check(settings->store, &fault))
        fprintf(stderr, "percussd: warning: store: %s: %s\n", settings->store, fault.text);
    if (database_check(settings->store, SCHEMA_VERSION, &fault) == PERCUSS_OK)
        return true;
    fprintf(stderr, "percussd: store: %s\n", fault.text);
    return false;
}

static bool check_security(const struct settings *settings)
{
    struct fault fault;
    char remark[512];
    if (!settings->security[0])
        return true;
    if (!endpoint_check_security(settings->security, &fault)) {
        fprintf(stderr, "percussd: %s\n", fault.text);
        return false;
    }
    if (identity_remark(settings->security, remark, sizeof remark))
        fprintf(stderr, "percussd: warning: %s\n", remark);
    return true;
}

static bool check_standby(const struct settings *settings)
{
    struct fault fault;
    if (!settings->standby[0] || !standby_check(settings->standby, &fault))
        return true;
    fprintf(stderr, "percussd: standby: %s\n", fault.text);
    return false;
}

/* Warns of a file that cannot be written later; a daemon starts without it. */
static void remark_file(const char *key, const char *path)
{
    struct fault fault;
    if (path[0] && limits_check_place(path, W_OK, &fault))
        fprintf(stderr, "percussd: warning: %s: %s\n", key, fault.text);
}

/* Joins the domain for a moment, with the identity, which was checked before. */
static bool check_domain(const struct settings *settings)
{
    dds_entity_t participant = wire_participant_create_secured(
        settings->domain, settings->security[0] ? settings->security : NULL);
    if (participant < 0)
        fprintf(stderr, "percussd: domain: %u: %s\n", settings->domain,
                wire_participant_problem(participant));
    else
        dds_delete(dds_get_parent(participant));
    return participant > 0;
}

/* Before DDS, which would end the process where a limit is too low. */
static bool check_limits(const struct settings *settings)
{
    struct fault fault;
    if (!limits_check(settings, &fault))
        return true;
    fprintf(stderr, "percussd: %s\n", fault.text);
    return false;
}

bool check_config(const struct settings *settings)
{
    bool (*const checks[])(const struct settings *) = {check_catalogue, check_tables, check_bodies,
                                                       check_store, check_standby};
    bool good = true;
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++)
        good = checks[i](settings) && good;
    good = check_security(settings) && check_limits(settings) && check_domain(settings) && good;
    remark_file("metrics", settings->metrics);
    remark_file("backup", settings->backup);
    if (good)
        puts("ok");
    return good;
}
