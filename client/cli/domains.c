/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "domains.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

/* RTPS 9.6.1.1: the ports of domain d begin at 7400 + 250 d; those of its processes at 10 beyond,
 * two for each, for discovery and for data; the first two are for multicast. */
enum { PORT_BASE = 7400, DOMAIN_GAIN = 250, FIRST_OFFSET = 10, PORTS = 65536 };

/* s; an announcement takes 0.1 s to come */
static const double PATIENCE = 0.5, SHORTEST = 0.02;

void domains_by_ports(FILE *table, bool taken[DOMAINS_COUNT])
{
    bool bound[PORTS] = {false};
    char line[256];
    unsigned port;
    /* "sl: address:port ...", in hexadecimal digits; the head of the table is no such line */
    while (fgets(line, sizeof line, table))
        if (sscanf(line, " %*u: %*8[0-9A-F]:%4X", &port) == 1)
            bound[port] = true;
    /* a pair of ports that is not bound by chance; other programs' ports may be among them all the
     * same */
    for (unsigned domain = 0; domain < DOMAINS_COUNT; domain++) {
        const unsigned first = PORT_BASE + DOMAIN_GAIN * domain;
        taken[domain] = first + 1 < PORTS && bound[first] && bound[first + 1];
        for (unsigned i = FIRST_OFFSET; i < DOMAIN_GAIN && first + i + 1 < PORTS; i += 2)
            taken[domain] = taken[domain] || (bound[first + i] && bound[first + i + 1]);
    }
}

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
    bool taken[DOMAINS_COUNT] = {false};
    struct percuss_client *clients[DOMAINS_MOST];
    unsigned asked[DOMAINS_MOST];
    size_t count = 0, found = 0;
    FILE *table = fopen("/proc/net/udp", "re");
    if (!table)
        return 0;
    domains_by_ports(table, taken);
    fclose(table);
    /* all are asked at once, and waited for together */
    const double end = now() + PATIENCE;
    for (unsigned domain = 0; domain < DOMAINS_COUNT && count < DOMAINS_MOST; domain++) {
        if (!taken[domain] || domain == common->domain || now() >= end)
            continue;
        asked[count] = domain;
        clients[count] = listen_in(common, domain);
        count += clients[count] != NULL;
    }
    for (size_t i = 0; i < count; i++) {
        if (announces(clients[i], fmax(SHORTEST, end - now())))
            domains[found++] = asked[i];
        percuss_client_free(clients[i]);
    }
    return found;
}
