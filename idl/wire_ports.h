/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* UDP ports of this machine, by which participants of DDS domains are known (RTPS 9.6.1.1). */
#ifndef PERCUSS_WIRE_PORTS_H
#define PERCUSS_WIRE_PORTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    WIRE_PORTS_COUNT = 65536,
    WIRE_PORTS_DOMAINS = 231,
    WIRE_PORTS_BASE = 7400,
    WIRE_PORTS_DOMAIN_GAIN = 250,
    WIRE_PORTS_FIRST_INDEX = 10 /* beyond the domain's first one; each index has two */
};

struct wire_ports {
    bool bound[WIRE_PORTS_COUNT];
};

/* Whose sockets count. */
struct wire_ports_owner {
    const unsigned long *sockets; /* their inodes; NULL: those of the user */
    size_t socket_count;
    unsigned user;
};

/* The ports that `table`, in the form of /proc/net/udp, lists. `owner` NULL: everybody's. */
void wire_ports_read(FILE *table, const struct wire_ports_owner *owner, struct wire_ports *ports);

/* Those of this network namespace; false: unknown. */
bool wire_ports_read_own(struct wire_ports *ports);

/* Whether a participant of the domain is there. */
bool wire_ports_have(const struct wire_ports *ports, uint32_t domain);

/* How many participant indices of the domain are taken, from `first` on without a gap. */
unsigned wire_ports_indices(const struct wire_ports *ports, uint32_t domain, unsigned first);

/* The first of the two ports of a participant index. */
unsigned wire_ports_of_index(uint32_t domain, unsigned index);

#endif
