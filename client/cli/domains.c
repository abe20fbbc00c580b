/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "domains.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "wire_ports.h"

/* s; an announcement takes 0.1 s to come */
static const double PATIENCE = 0.5, SHORTEST = 0.02;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static bool announces(struct percuss_client *client, double timeout)
{
    struct percuss_server_list list;
    if (percuss_servers(client, timeout, &list) != PERCUSS_RESULT_OK)
        return false;
    bool found = list.count > 0;
    percuss_server_list_free(&list);
    return found;
}

/* A client in another domain, which begins to receive announcements. NULL: none. */
static struct percuss_client *listen_in(const struct common *common, unsigned domain)
{
    struct percuss_client_config config = {.domain = domain, .first_sequence = 1, .window = 1};
    struct percuss_client *client;
    if (percuss_client_create_in(&config, common->partition, common->security, &client) !=
        PERCUSS_RESULT_OK)
        return NULL;
    announces(client, 0.0);
    return client;
}

size_t domains_with_server(const struct common *common, unsigned domains[DOMAINS_MOST])
{
    struct percuss_client *clients[DOMAINS_MOST];
    unsigned asked[DOMAINS_MOST];
    size_t count = 0, found = 0;
    struct wire_ports *ports = malloc(sizeof *ports);
    if (!ports || !wire_ports_read_own(ports)) {
        free(ports);
        return 0;
    }
    /* all are asked at once, and waited for together */
    const double end = now() + PATIENCE;
    for (unsigned domain = 0; domain < WIRE_PORTS_DOMAINS && count < DOMAINS_MOST; domain++) {
        if (!wire_ports_have(ports, domain) || domain == common->domain || now() >= end)
            continue;
        asked[count] = domain;
        clients[count] = listen_in(common, domain);
        count += clients[count] != NULL;
    }
    free(ports);
    for (size_t i = 0; i < count; i++) {
        if (announces(clients[i], fmax(SHORTEST, end - now())))
            domains[found++] = asked[i];
        percuss_client_free(clients[i]);
    }
    return found;
}
