/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <string.h>

#include "announcements.h"
#include "error.h"
#include "library.h"
#include "lists.h"
#include "moment.h"
#include "receive.h"

/* Whether they are the whole catalogue that the server says it has. During a reload bodies of two
 * catalogues are there, and the status comes after the last body. */
static bool is_whole(const struct lists_bodies *made, const struct percuss_server *server)
{
    bool old = made->list.catalogue_revision[0] == '\0';
    return made->list.count >= server->bodies && !made->mixed &&
           (old || made->list.count == 0 ||
            strcmp(made->list.catalogue_revision, server->catalogue_revision) == 0);
}

/* One look at the bodies of a server. PENDING: not all of one catalogue are there. */
static enum percuss_result look_at_bodies(struct percuss_client *client, dds_entity_t reader,
                                          const struct percuss_server *server,
                                          struct percuss_body_list *list)
{
    struct announcements all;
    enum percuss_result result = announcements_read(client, reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* of all announcements those of this server */
    struct lists_bodies made = lists_begin_bodies((size_t)all.count);
    for (int i = 0; i < all.count; i++) {
        const percuss_v1_Body *wire = all.samples[i];
        if (all.infos[i].valid_data && memcmp(wire->server, server->server, 16) == 0)
            lists_add_body(&made, wire);
    }
    announcements_release(&all);
    /* more are on their way */
    if (!made.failed && !is_whole(&made, server)) {
        percuss_body_list_free(&made.list);
        return PERCUSS_RESULT_PENDING;
    }
    return lists_end_bodies(&made, list);
}

enum percuss_result bodies_list(struct percuss_client *client, double timeout,
                                struct percuss_body_list *list)
{
    struct percuss_server server = {0};
    double deadline;
    *list = (struct percuss_body_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    /* opened first, so that the copies arrive while we wait for the server's announcement */
    if (result == PERCUSS_RESULT_OK)
        result = announcements_open(client, &client->body_reader, &percuss_v1_Body_desc,
                                    WIRE_TOPIC_BODY);
    if (result == PERCUSS_RESULT_OK)
        result = announcements_connected(client, timeout, &server);
    if (result != PERCUSS_RESULT_OK)
        return result;
    while ((result = look_at_bodies(client, client->body_reader, &server, list)) ==
           PERCUSS_RESULT_PENDING) {
        if (moment_now() >= deadline)
            return error_set(PERCUSS_RESULT_TIMEOUT,
                             "%s has not announced all its %u bodies within %g s",
                             client->server_name, server.bodies, timeout);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
        result = announcements_connected(client, fmax(deadline - moment_now(), 0.0), &server);
        if (result != PERCUSS_RESULT_OK)
            break;
    }
    return result;
}
