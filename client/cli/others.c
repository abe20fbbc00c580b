/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "others.h"

#include <stdio.h>
#include <string.h>

static bool is_alike(const struct percuss_server *other, const struct percuss_server *ours)
{
    return strcmp(other->catalogue_revision, ours->catalogue_revision) == 0;
}

static void warn(const struct percuss_server *other, const struct percuss_server *ours)
{
    char id[33], our_id[33];
    format_hex(other->server, id);
    format_hex(ours->server, our_id);
    if (!is_alike(other, ours))
        complain(
            "WARNING: percussd %.8s (process %u on %s) answers here too, with ANOTHER "
            "CATALOGUE (%s); asked is percussd %.8s (process %u, %s): stop one of them, choose "
            "with --server, or give each a domain of its own (--domain N, PERCUSS_DOMAIN)",
            id, other->process, other->host, other->catalogue, our_id, ours->process,
            ours->catalogue);
    else
        complain("warning: percussd %.8s (process %u on %s) answers here too, with the same "
                 "catalogue; asked is percussd %.8s: choose with --server",
                 id, other->process, other->host, our_id);
}

/* The one of the list that the client stays with; NULL: it is not there. */
static const struct percuss_server *find_ours(const struct percuss_server_list *list,
                                              struct percuss_client *client)
{
    uint8_t server[16];
    percuss_client_server(client, server);
    for (size_t i = 0; i < list->count; i++)
        if (memcmp(list->servers[i].server, server, sizeof server) == 0)
            return &list->servers[i];
    return NULL;
}

int others_settle(const struct common *common, struct percuss_client *client)
{
    struct percuss_server_list list;
    if (common_names_server(common) ||
        percuss_servers(client, common_patience(common), &list) != PERCUSS_RESULT_OK)
        return EXIT_ANSWERED;
    /* with a choice by load the user knows that there are several, but not that they differ */
    const bool any = !common->server[0];
    const struct percuss_server *ours = find_ours(&list, client);
    int code = EXIT_ANSWERED;
    /* the first one has come to light while we stayed with another */
    if (ours && any && ours != list.servers && strcmp(list.servers[0].state, "ready") == 0) {
        code = connect_client(common, client);
        ours = find_ours(&list, client);
    }
    for (size_t i = 0; code == EXIT_ANSWERED && ours && i < list.count; i++)
        if (&list.servers[i] != ours && (any || !is_alike(&list.servers[i], ours)))
            warn(&list.servers[i], ours);
    percuss_server_list_free(&list);
    return code;
}

void others_explain(const struct common *common, struct percuss_client *client)
{
    struct percuss_server_list list;
    char id[33];
    if (percuss_servers(client, common_patience(common), &list) != PERCUSS_RESULT_OK)
        return;
    const struct percuss_server *ours = find_ours(&list, client);
    size_t unlike = 0;
    for (size_t i = 0; ours && i < list.count; i++)
        unlike += !is_alike(&list.servers[i], ours);
    if (ours && common->local) {
        complain("that is the catalogue %s", ours->catalogue);
    } else if (ours) {
        format_hex(ours->server, id);
        complain("that is the catalogue %s of percussd %.8s (process %u on %s) in DDS domain %u%s",
                 ours->catalogue, id, ours->process, ours->host, common->domain,
                 unlike
                     ? ""
                     : "; a daemon of another domain is asked by --domain N or PERCUSS_DOMAIN=N");
    }
    for (size_t i = 0; unlike && i < list.count; i++) {
        const struct percuss_server *other = &list.servers[i];
        if (is_alike(other, ours))
            continue;
        format_hex(other->server, id);
        complain("percussd %.8s (process %u on %s) in this domain has another catalogue, %s: "
                 "--server %.8s asks it; better, give each daemon a domain of its own: percussd "
                 "--domain N, and --domain N or PERCUSS_DOMAIN=N here",
                 id, other->process, other->host, other->catalogue, id);
    }
    percuss_server_list_free(&list);
}

void print_server_line(const uint8_t server[16], const char *catalogue_revision)
{
    char id[33];
    format_hex(server, id);
    /* as percuss/local.h says */
    bool here = memcmp(server, "percuss in here", 16) == 0;
    printf("  server       %.8s, catalogue revision %.8s\n", here ? "none" : id,
           catalogue_revision);
}
