/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* This machine: its interfaces, the participants' ports, and the daemons that run here. */
#ifndef PERCUSS_DOCTOR_MACHINE_H
#define PERCUSS_DOCTOR_MACHINE_H

#include "finding.h"
#include "wire_daemons.h"

/* `network`: whether other machines are to be reached. */
void machine_look_at_interfaces(bool network, struct findings *findings);

/* Whether the interface of this address has multicast, and a multicast packet that is sent from it
 * comes back within a moment. */
bool machine_multicasts(const char *address);

/* Participant indices of clients that are taken in the domain, without a gap. */
unsigned machine_indices(uint32_t domain);

/* Finds the daemons that run here and have ports in the domain. `answered`: one of the domain has
 * answered, so that another configuration is no fault. Their number, and them in `daemons`, which
 * has room for WIRE_DAEMONS_MOST. */
size_t machine_look_at_daemons(uint32_t domain, bool answered, struct wire_daemon *daemons,
                               struct findings *findings);

#endif
