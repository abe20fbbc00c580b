/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss status: what the servers of the domain announce. */

#include <math.h>
#include <stdio.h>

#include "cli.h"
#include "json_writer.h"

JSON_TABLE(server, PERCUSS_SERVER_FIELDS)

static void print_json(const struct percuss_server_list *list)
{
    json_t *root = json_object(), *array = json_array();
    json_object_set_new(root, "servers", array);
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(array, json_object_of(server_members(), &list->servers[i]));
    json_print(root);
}

static void print_server(const struct percuss_server *server)
{
    char id[33];
    format_hex(server->server, id);
    printf("server      %s, percussd %s, %s\n", id, server->version, server->state);
    printf("process     %u on %s, up %.0f s, %u workers\n", server->process, server->host,
           server->uptime, server->workers);
    printf("catalogue   %s, %u bodies, revision %s\n", server->catalogue, server->bodies,
           server->catalogue_revision);
    printf("requests    %llu answered, %llu refused, %u of %u places in the queue taken\n",
           (unsigned long long)server->answered, (unsigned long long)server->refused,
           server->queue_length, server->queue_capacity);
    if (server->activity[0])
        printf("activity    %s, %.0f %%\n", server->activity, 100.0 * server->progress);
}

int command_status(int argc, char **argv, struct common *common)
{
    struct percuss_client *client;
    struct percuss_server_list list;
    parse_only_common(argc, argv, "Shows what the servers are doing.", common);
    int code = make_client(common, NULL, &client);
    if (code == EXIT_ANSWERED && !percuss_client_observes(client))
        code = connect_client(common, client);
    /* what a server announces that does not answer is of interest, too */
    if (code != EXIT_ANSWERED && code != EXIT_TIMEOUT) {
        percuss_client_free(client);
        return code;
    }
    enum percuss_result result = percuss_servers(client, common_timeout(common), &list);
    if (result != PERCUSS_RESULT_OK)
        code = complain_result(result);
    else if (common->json)
        print_json(&list);
    for (size_t i = 0; !common->json && i < list.count; i++)
        print_server(&list.servers[i]);
    percuss_server_list_free(&list);
    percuss_client_free(client);
    return code;
}
