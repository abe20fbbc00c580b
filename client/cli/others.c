/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "others.h"

#include <stdio.h>
#include <string.h>

static void warn(const struct percuss_server *other, const struct percuss_server *ours)
{
    char id[33], our_id[33];
    format_hex(other->server, id);
    format_hex(ours->server, our_id);
    if (strcmp(other->catalogue_revision, ours->catalogue_revision) != 0)
        complain("WARNING: percussd %.8s (process %u on %s) answers here too, with ANOTHER "
                 "CATALOGUE (%s); asked is percussd %.8s (%s): choose with --server",
                 id, other->process, other->host, other->catalogue, our_id, ours->catalogue);
    else
        complain("warning: percussd %.8s (process %u on %s) answers here too, with the same "
                 "catalogue; asked is percussd %.8s: choose with --server",
                 id, other->process, other->host, our_id);
}

void others_warn(const struct common *common, struct percuss_client *client)
{
    uint8_t server[16];
    struct percuss_server_list list;
    if (common->server[0] || !percuss_client_server(client, server) ||
        percuss_servers(client, common_patience(common), &list) != PERCUSS_RESULT_OK)
        return;
    const struct percuss_server *ours = NULL;
    for (size_t i = 0; i < list.count; ++i)
        if (memcmp(list.servers[i].server, server, sizeof server) == 0)
            ours = &list.servers[i];
    for (size_t i = 0; ours && i < list.count; ++i)
        if (&list.servers[i] != ours)
            warn(&list.servers[i], ours);
    percuss_server_list_free(&list);
}

void print_server_line(const uint8_t server[16], const char *catalogue_revision)
{
    char id[33];
    format_hex(server, id);
    printf("  server       %.8s, catalogue revision %.8s\n", id, catalogue_revision);
}
