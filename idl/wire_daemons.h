/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Processes of this machine that run percussd, whether DDS hears them or not, and by which
 * configuration of DDS: that of two programs may be such that they never hear each other. */
#ifndef PERCUSS_WIRE_DAEMONS_H
#define PERCUSS_WIRE_DAEMONS_H

#include "wire_ports.h"

enum { WIRE_DAEMONS_MOST = 16, WIRE_CONFIGURATION_SIZE = 1024 };

struct wire_daemon {
    long process;
    unsigned user;
    bool stopped;   /* by a signal, or a debugger */
    bool readable;  /* its environment and its sockets */
    bool elsewhere; /* in another network namespace, such as a container's */
    char configuration[WIRE_CONFIGURATION_SIZE]; /* its CYCLONEDDS_URI, if readable, as far as it
                                                    goes; empty: not set */
    bool domains[WIRE_PORTS_DOMAINS]; /* where it has ports; of one that is not readable: where any
                                         process of its user has */
};

/* Their number; `daemons` has room for WIRE_DAEMONS_MOST. */
size_t wire_daemons_find(struct wire_daemon *daemons);

/* How its configuration stands to ours. */
enum wire_likeness { WIRE_ALIKE, WIRE_UNLIKE, WIRE_UNKNOWN };
enum wire_likeness wire_daemon_likeness(const struct wire_daemon *daemon);

/* Whether one has ports in that domain. */
bool wire_daemons_are_in(uint32_t domain);

/* Words for why no daemon is heard in that domain, as far as CYCLONEDDS_URI here and there may be
 * why: "; percussd (process 4711) is there with CYCLONEDDS_URI=..., which is not set here, ...". */
void wire_daemons_explain(uint32_t domain, char *text, size_t size);

#endif
