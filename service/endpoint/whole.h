/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether a sample from the wire may be decoded.
 *
 * A sample may end before the members of its type do; what is missing then gets a default. Cyclone
 * DDS 0.10.2 ends the process instead where the missing member is an @appendable struct. Of the
 * types that the daemon reads, only Request and EnsembleRequest have such members. */
#ifndef PERCUSS_ENDPOINT_WHOLE_H
#define PERCUSS_ENDPOINT_WHOLE_H

#include <stdbool.h>
#include <stddef.h>

#include "endpoint/answer.h"

/* Whether every struct member of a request is there. `data`: its XCDR2 form as DDS hands it out,
 * checked by DDS and in this machine's byte order, `size` bytes from the encapsulation header on.
 */
bool whole_request(enum exchange exchange, const void *data, size_t size);

#endif
