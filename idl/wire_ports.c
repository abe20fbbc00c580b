/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_ports.h"

#include <string.h>

static bool is_owned(const struct wire_ports_owner *owner, unsigned user, unsigned long socket)
{
    if (!owner->sockets)
        return owner->user == user;
    for (size_t i = 0; i < owner->socket_count; i++)
        if (owner->sockets[i] == socket)
            return true;
    return false;
}

void wire_ports_read(FILE *table, const struct wire_ports_owner *owner, struct wire_ports *ports)
{
    char line[256];
    unsigned port, user;
    unsigned long socket;
    memset(ports, 0, sizeof *ports);
    /* "sl: address:port remote state queues timer retransmits user timeout inode ...", ports in
     * hexadecimal digits; the head of the table is no such line */
    while (fgets(line, sizeof line, table)) {
        int read = sscanf(line, " %*u: %*8[0-9A-F]:%4X %*s %*s %*s %*s %*s %u %*u %lu", &port,
                          &user, &socket);
        if (read >= 1 && (!owner || (read == 3 && is_owned(owner, user, socket))))
            ports->bound[port] = true;
    }
}

bool wire_ports_read_own(struct wire_ports *ports)
{
    FILE *table = fopen("/proc/net/udp", "re");
    if (!table)
        return false;
    wire_ports_read(table, NULL, ports);
    fclose(table);
    return true;
}

/* The first two ports are for multicast; then two for each process, for discovery and for data.
 * Only a pair tells of a participant: another program may have one of them by chance. */
bool wire_ports_have(const struct wire_ports *ports, uint32_t domain)
{
    const unsigned first = WIRE_PORTS_BASE + WIRE_PORTS_DOMAIN_GAIN * domain;
    const unsigned end = first + WIRE_PORTS_DOMAIN_GAIN;
    bool have = first + 1 < WIRE_PORTS_COUNT && ports->bound[first] && ports->bound[first + 1];
    for (unsigned i = first + WIRE_PORTS_FIRST_INDEX; i < end && i + 1 < WIRE_PORTS_COUNT; i += 2)
        have = have || (ports->bound[i] && ports->bound[i + 1]);
    return have;
}

unsigned wire_ports_of_index(uint32_t domain, unsigned index)
{
    return WIRE_PORTS_BASE + WIRE_PORTS_DOMAIN_GAIN * domain + WIRE_PORTS_FIRST_INDEX + 2 * index;
}

/* One of the two is enough to keep others from an index. */
unsigned wire_ports_indices(const struct wire_ports *ports, uint32_t domain, unsigned first)
{
    unsigned index = first, port;
    while ((port = wire_ports_of_index(domain, index)) + 1 < WIRE_PORTS_COUNT &&
           (ports->bound[port] || ports->bound[port + 1]))
        index++;
    return index - first;
}
