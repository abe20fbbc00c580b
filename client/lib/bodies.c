/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <string.h>

#include "announcements.h"
#include "error.h"
#include "library.h"
#include "lists.h"
#include "moment.h"
#include "receive.h"

/* One look at the bodies of a server. PENDING: fewer than `expected`. */
static enum percuss_result look_at_bodies(struct percuss_client *client, dds_entity_t reader,
                                          const struct percuss_server *server,
                                          struct percuss_body_list *list)
{
    struct announcements all;
    enum percuss_result result = announcements_read(client, reader, &all);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* of all announcements those of this server */
    bool good = lists_begin_bodies(list, (size_t)all.count);
    for (int i = 0; good && i < all.count; i++) {
        const percuss_v1_Body *wire = all.samples[i];
        if (all.infos[i].valid_data && memcmp(wire->server, server->server, 16) == 0)
            good = lists_add_body(list, wire);
    }
    announcements_release(&all);
    /* more are on their way */
    if (good && list->count < server->bodies) {
        percuss_body_list_free(list);
        return PERCUSS_RESULT_PENDING;
    }
    return lists_end_bodies(list, good);
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
    /* complete when as many are there as the server says it has */
    while ((result = look_at_bodies(client, client->body_reader, &server, list)) ==
           PERCUSS_RESULT_PENDING) {
        if (moment_now() >= deadline)
            return error_set(PERCUSS_RESULT_TIMEOUT,
                             "%s has not announced all its %u bodies within %g s",
                             client->server_name, server.bodies, timeout);
        dds_sleepfor(ANNOUNCEMENTS_INTERVAL);
    }
    return result;
}
