/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Puts the parts of a batch reply together. */
#ifndef PERCUSS_LIB_BATCH_H
#define PERCUSS_LIB_BATCH_H

#include <percuss/percuss.h>

#include "percuss_wire.h"

/* Parts may come in any order and twice, so each keeps its place until all are there. */
struct batch {
    uint8_t server[16]; /* of the first part to arrive; others' parts are dropped */
    uint32_t parts;     /* 0: none has arrived */
    uint32_t missing;
    struct batch_part {
        bool arrived;
        size_t count;
        struct percuss_reply *replies;
    } * part;
    enum percuss_status status; /* of the whole */
    char message[1024];
};

/* Files one part. PENDING while parts are missing, OK when all have come, NO_MEMORY. */
enum percuss_result batch_add_part(struct batch *batch, const percuss_v1_BatchReply *wire);

/* Moves the replies of a complete batch to `replies` in order. Where the server sent fewer than
 * `count`, each missing one gets the status and message of the whole. */
void batch_collect(struct batch *batch, struct percuss_reply *replies, size_t count);

/* Frees the replies not collected and empties the batch. */
void batch_clear(struct batch *batch);

#endif
