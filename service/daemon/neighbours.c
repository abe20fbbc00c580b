/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/neighbours.h"

#include <stdio.h>
#include <string.h>

#include "daemon/log.h"

struct look {
    struct neighbours *neighbours;
    const uint8_t *server; /* our own id */
    const struct neighbours_self *self;
};

/* The known one of that id, or a place for it at the end; NULL: no room. */
static struct neighbour *find(struct neighbours *neighbours, const uint8_t server[16])
{
    size_t i = 0;
    while (i < neighbours->count && memcmp(neighbours->each[i].server, server, 16) != 0)
        i++;
    return i < NEIGHBOURS_MOST ? &neighbours->each[i] : NULL;
}

static void warn(const struct look *look, const struct neighbour *neighbour,
                 const percuss_v1_ServerStatus *status)
{
    const struct neighbours_self *self = look->self;
    if (memcmp(status->server, look->server, 16) == 0)
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
        log_line(
            LEVEL_WARNING,
            "%s answers in this domain too, with ANOTHER CATALOGUE: %s (revision %.8s), ours "
            "is %s (revision %.8s): answers depend on which server a client asks: stop one of "
            "the two, or start it outside domain %u by --domain N or PERCUSS_DOMAIN=N, and its "
            "clients too",
            neighbour->name, *status->catalogue ? status->catalogue : "of an unknown path",
            status->catalogue_revision, self->catalogue, self->revision, self->domain);
}

static void note(void *context, const percuss_v1_ServerStatus *status)
{
    const struct look *look = context;
    struct neighbours *neighbours = look->neighbours;
    struct neighbour *neighbour = find(neighbours, status->server);
    bool alike = strcmp(status->catalogue_revision, look->self->revision) == 0;
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
    warn(look, neighbour, status);
}

void neighbours_look(struct neighbours *neighbours, struct endpoint *endpoint,
                     const struct neighbours_self *self)
{
    struct look look = {neighbours, endpoint_server(endpoint), self};
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
