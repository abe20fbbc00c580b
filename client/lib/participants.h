/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The DDS participants of this process: one a domain and identity, for all its clients. Any thread.
 *
 * Cyclone DDS 0.10 lets only the first of several participants learn what a newly found process had
 * before (q_receive.c: readers of discovery after the first are in sync at once); when that one is
 * deleted before it has, the others never do. Clients with a participant each, one freed while a
 * server comes up, would not find that server until all of them were gone. */
#ifndef PERCUSS_LIB_PARTICIPANTS_H
#define PERCUSS_LIB_PARTICIPANTS_H

#include "wire.h"

/* The participant of that domain and identity (a folder; NULL: none), made by the first who holds
 * it; or a negative DDS code. */
dds_entity_t participants_hold(uint32_t domain, const char *security);

/* Deletes it after the last one. What it was asked to make is to be deleted before. */
void participants_release(dds_entity_t participant);

#endif
