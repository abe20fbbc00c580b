/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdlib.h>
#include <string.h>

#include "announcements.h"
#include "error.h"
#include "receive.h"

static void convert_body(const percuss_v1_Body *wire, struct percuss_body *body)
{
    *body = (struct percuss_body){
        .mass = wire->mass,
        .radius = wire->radius,
        .tip_radius = wire->tip_radius,
        .supports = {wire->supports[0], wire->supports[1]},
    };
    memcpy(body->id, wire->id, sizeof body->id);
    memcpy(body->shape, wire->shape, sizeof body->shape);
    memcpy(body->material, wire->material, sizeof body->material);
    memcpy(body->description, wire->description, sizeof body->description);
    _Static_assert(sizeof body->parameters == sizeof wire->parameters + sizeof wire->scale,
                   "as many as on the wire");
    memcpy(body->parameters, wire->parameters, sizeof wire->parameters);
    body->parameters[PERCUSS_PARAMETER_SCALE] = wire->scale;
    memcpy(body->inertia, wire->inertia, sizeof body->inertia);
    memcpy(body->products, wire->products, sizeof body->products);
    for (uint32_t i = 0; i < wire->sites._length && i < PERCUSS_MAX_SITES; i++) {
        struct percuss_site *site = &body->sites[body->site_count++];
        memcpy(site->name, wire->sites._buffer[i].name, sizeof site->name);
        memcpy(site->point, wire->sites._buffer[i].point, sizeof site->point);
        memcpy(site->normal, wire->sites._buffer[i].normal, sizeof site->normal);
    }
    memcpy(body->half_extents, wire->half_extents, sizeof body->half_extents);
}

static int compare_ids(const void *left, const void *right)
{
    const struct percuss_body *a = left, *b = right;
    return strcmp(a->id, b->id);
}

/* One look at the bodies of a server. PENDING: fewer than `expected`. */
static enum percuss_result look_at_bodies(struct percuss_client *client, dds_entity_t reader,
                                          const struct percuss_server *server,
                                          struct percuss_body_list *list)
{
    struct announcements all;
    enum percuss_result result = announcements_read(client, reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* of all that is announced what is this server's */
    list->count = 0;
    list->bodies = calloc((size_t)all.count + 1, sizeof *list->bodies);
    for (int i = 0; list->bodies && i < all.count; i++) {
        const percuss_v1_Body *wire = all.samples[i];
        if (all.infos[i].valid_data && memcmp(wire->server, server->server, 16) == 0)
            convert_body(wire, &list->bodies[list->count++]);
    }
    announcements_release(&all);
    if (!list->bodies)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a list of bodies");
    /* more are on their way */
    if (list->count < server->bodies) {
        percuss_body_list_free(list);
        return PERCUSS_RESULT_PENDING;
    }
    qsort(list->bodies, list->count, sizeof *list->bodies, compare_ids);
    return PERCUSS_RESULT_OK;
}

enum percuss_result percuss_bodies(struct percuss_client *client, double timeout,
                                   struct percuss_body_list *list)
{
    struct percuss_server server = {0};
    double deadline;
    *list = (struct percuss_body_list){0};
    enum percuss_result result = receive_deadline(timeout, &deadline);
    /* opened first, so that the copies arrive while we wait for the server's announcement */
    if (result == PERCUSS_RESULT_OK)
        result = announcements_open(client, &client->body_reader, &percuss_v1_Body_desc,
                                    WIRE_TOPIC_BODY);
    if (result == PERCUSS_RESULT_OK)
        result = announcements_connected(client, timeout, &server);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* complete when as many are there as the server says it has */
    while ((result = look_at_bodies(client, client->body_reader, &server, list)) ==
           PERCUSS_RESULT_PENDING) {
        if (receive_now() >= deadline)
            return error_set(PERCUSS_RESULT_TIMEOUT,
                             "the server has not announced all its %u bodies", server.bodies);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}

const struct percuss_body *percuss_body_find(const struct percuss_body_list *list, const char *id)
{
    for (size_t i = 0; i < list->count; i++)
        if (!strcmp(list->bodies[i].id, id))
            return &list->bodies[i];
    return NULL;
}

void percuss_body_list_free(struct percuss_body_list *list)
{
    if (!list)
        return;
    free(list->bodies);
    *list = (struct percuss_body_list){0};
}
