/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A DDS domain that hears this machine only. */
#ifndef PERCUSS_WIRE_LOOPBACK_H
#define PERCUSS_WIRE_LOOPBACK_H

#include <dds/dds.h>

/* Participant indices, one for each process: a server's from 0 on, a client's from the 17th, 16,
 * on; so many as MaxAutoParticipantIndex says, since Cyclone DDS 0.10.2 fails at the last one. The
 * ports of the next one but one are another domain's. */
enum { WIRE_LOOPBACK_INDICES = 119, WIRE_LOOPBACK_CLIENTS = 16 };

/* What a process is among those of the domain. */
enum wire_side {
    WIRE_SERVER, /* or any other: all processes are told that it is there */
    WIRE_CLIENT  /* the first 16 that are no clients are told at once, further ones when they tell
                    of themselves, which they do each 1.4 s, and clients never */
};

/* Makes the domain in this process: loopback interface, no multicast, up to 119 processes, 103 of
 * them clients, and its sockets take nothing that does not come from 127.0.0.0/8. Returns it or a
 * negative DDS return code: DDS_RETCODE_PRECONDITION_NOT_MET when the process has the domain
 * already, which is left as it is; DDS_RETCODE_UNSUPPORTED when its sockets cannot be closed to
 * others. */
dds_entity_t wire_loopback_create(uint32_t domain, enum wire_side side);

#endif
