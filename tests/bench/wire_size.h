/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How large a request and its reply are on the wire. */
#ifndef PERCUSS_BENCH_WIRE_SIZE_H
#define PERCUSS_BENCH_WIRE_SIZE_H

#include "queries.h"

struct wire_size {
    size_t request, reply; /* serialised, octets */
};

/* Asks the query through `client` while other readers look on, which are gone afterwards. False: no
 * answer within 20 s. */
bool wire_size_find(uint32_t domain, struct percuss_client *client, const struct query *query,
                    struct wire_size *size);

#endif
