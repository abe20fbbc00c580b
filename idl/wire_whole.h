/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether bytes from the network are a sample of a type, before DDS looks at them.
 *
 * Cyclone DDS 0.10.2 checks them too, but not well enough. In XCDR2 it takes an 8-byte number for
 * one of 4 when it looks whether a member, an array or a sequence of them fits: it swaps and reads
 * up to half of that beyond the sample, and goes on from a wrong place. A sample may also end
 * before the members of its type do; what is missing then gets a default, but where that is an
 * @appendable struct the process is ended. */
#ifndef PERCUSS_WIRE_WHOLE_H
#define PERCUSS_WIRE_WHOLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Whether every member that is there fits into its struct, list and sample, every list into its
 * bound and, unless it is one of numbers, into 64 MiB of memory, and no key and no struct member is
 * missing. `ops`: instructions of the type as idlc writes them (m_ops of a topic's descriptor):
 * @appendable or @final structs of numbers, booleans, strings, arrays of numbers, sequences and
 * structs; anything else is refused. `data`: `size` bytes of XCDR2 after the encapsulation header,
 * `swapped`: not in this machine's byte order. */
bool wire_whole(const uint32_t *ops, const void *data, size_t size, bool swapped);

/* The same in XCDR of that version: 1 (of @final structs alone, as ROS 2 has them) or 2. */
bool wire_whole_in(int version, const uint32_t *ops, const void *data, size_t size, bool swapped);

#endif
