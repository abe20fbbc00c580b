/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bytes of XCDR2 in this machine's byte order as samples: the same that Cyclone DDS reads. */
#ifndef PERCUSS_WIRE_READ_H
#define PERCUSS_WIRE_READ_H

#include "wire_plan.h"

/* Whether bytes from the network are a sample with all of its members: of those wire_whole() lets
 * pass and Cyclone DDS takes after it. What is not may still be one of an older version, which has
 * fewer. */
bool wire_read_is_complete(const struct wire_plan *plan, const uint8_t *data, size_t size);

/* Reads them into a sample that is zeroed or was read before: its memory serves again. False: they
 * are not complete, or a list of the sample is too short and not its own; what is in it then can be
 * read over and freed. */
bool wire_read(const struct wire_plan *plan, const uint8_t *data, size_t size, void *sample);

#endif
