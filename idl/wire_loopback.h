/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A DDS domain that hears this machine only. */
#ifndef PERCUSS_WIRE_LOOPBACK_H
#define PERCUSS_WIRE_LOOPBACK_H

#include <dds/dds.h>

/* Participant indices, one for each process: from 0 on, so many as MaxAutoParticipantIndex says,
 * since Cyclone DDS 0.10.2 fails at the last one. */
enum { WIRE_LOOPBACK_INDICES = 100 };

/* Makes the domain in this process: loopback interface, no multicast, up to 100 processes, and its
 * sockets take nothing that does not come from 127.0.0.0/8. Returns it or a negative DDS return
 * code: DDS_RETCODE_PRECONDITION_NOT_MET when the process has the domain already, which is left as
 * it is; DDS_RETCODE_UNSUPPORTED when its sockets cannot be closed to others. */
dds_entity_t wire_loopback_create(uint32_t domain);

#endif
