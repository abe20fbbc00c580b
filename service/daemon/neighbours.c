/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/neighbours.h"

#include <stdio.h>
#include <string.h>

#include "daemon/log.h"

struct look {
    struct neighbours *neighbours;
    const uint8_t *server; /* our own id */
    const char *revision;
};

/* The known one of that id, or a place for it at the end; NULL: no room. */
static struct neighbour *find(struct neighbours *neighbours, const uint8_t server[16])
{
    size_t i = 0;
    while (i < neighbours->count && memcmp(neighbours->each[i].server, server, 16) != 0)
        i++;
    return i < NEIGHBOURS_MOST ? &neighbours->each[i] : NULL;
}

static void warn(const struct neighbour *neighbour, const percuss_v1_ServerStatus *status,
                 bool has_our_id)
{
    if (has_our_id)
        log_line(LEVEL_ERROR,
                 "%s answers in this domain under the id of this one: the file `standby` of its "
                 "settings is a copy of ours: one of the two must end",
                 neighbour->name);
    else if (neighbour->alike)
        log_line(LEVEL_WARNING,
                 "%s answers in this domain too, with the same catalogue: clients that name no "
                 "server ask the one that has been up longest",
                 neighbour->name);
    else
        log_line(LEVEL_WARNING,
                 "%s answers in this domain too, with ANOTHER CATALOGUE (%s, revision %s): answers "
                 "depend on which server a client asks",
                 neighbour->name, status->catalogue, status->catalogue_revision);
}

static void note(void *context, const percuss_v1_ServerStatus *status)
{
    const struct look *look = context;
    struct neighbours *neighbours = look->neighbours;
    struct neighbour *neighbour = find(neighbours, status->server);
    bool alike = strcmp(status->catalogue_revision, look->revision) == 0;
    neighbours->others += memcmp(status->server, look->server, 16) != 0;
    if (!neighbour)
        return;
    /* who it is */
    bool is_new = neighbour == &neighbours->each[neighbours->count];
    if (is_new) {
        memcpy(neighbour->server, status->server, sizeof neighbour->server);
        snprintf(neighbour->name, sizeof neighbour->name,
                 "percussd %02x%02x%02x%02x (process %u on %s)", status->server[0],
                 status->server[1], status->server[2], status->server[3], status->process,
                 status->host);
        neighbours->count++;
    }
    /* what is new of it */
    neighbour->there = true;
    if (!is_new && alike == neighbour->alike)
        return;
    neighbour->alike = alike;
    warn(neighbour, status, memcmp(status->server, look->server, 16) == 0);
}

void neighbours_look(struct neighbours *neighbours, struct endpoint *endpoint, const char *revision)
{
    struct look look = {neighbours, endpoint_server(endpoint), revision};
    neighbours->others = 0;
    for (size_t i = 0; i < neighbours->count; i++)
        neighbours->each[i].there = false;
    endpoint_visit_servers(endpoint, note, &look);
    for (size_t i = neighbours->count; i-- > 0;) {
        if (neighbours->each[i].there)
            continue;
        log_line(LEVEL_INFO, "%s has gone from this domain", neighbours->each[i].name);
        neighbours->each[i] = neighbours->each[--neighbours->count];
    }
}
