/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "batch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "error.h"

static enum percuss_result start(struct batch *batch, const percuss_v1_BatchReply *wire)
{
    batch->part = calloc(wire->parts, sizeof *batch->part);
    if (!batch->part)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a batch reply of %u parts", wire->parts);
    batch->parts = batch->missing = wire->parts;
    memcpy(batch->server, wire->server, sizeof batch->server);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result convert_part(const percuss_v1_BatchReply *wire, struct batch_part *part)
{
    uint32_t count = wire->replies._length;
    part->replies = calloc(count ? count : 1, sizeof *part->replies);
    if (!part->replies)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "%u replies", count);
    part->arrived = true;
    for (part->count = 0; part->count < count; part->count++)
        if (convert_reply(&wire->replies._buffer[part->count], &part->replies[part->count]))
            return PERCUSS_RESULT_NO_MEMORY;
    return PERCUSS_RESULT_OK;
}

enum percuss_result batch_add_part(struct batch *batch, const percuss_v1_BatchReply *wire)
{
    enum percuss_result result = PERCUSS_RESULT_OK;
    /* no such part */
    if (wire->part >= wire->parts || wire->parts > PERCUSS_MAX_BATCH)
        return PERCUSS_RESULT_PENDING;
    /* whichever comes first says how many there are */
    if (batch->parts == 0)
        result = start(batch, wire);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* one that is there already, or of another answer than the first */
    if (wire->parts != batch->parts || batch->part[wire->part].arrived ||
        memcmp(batch->server, wire->server, sizeof batch->server) != 0)
        return PERCUSS_RESULT_PENDING;
    result = convert_part(wire, &batch->part[wire->part]);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* the first part's status stands unless another one failed */
    if (wire->status != PERCUSS_OK || batch->missing == batch->parts) {
        batch->status = wire->status;
        memcpy(batch->message, wire->message, sizeof batch->message);
    }
    return --batch->missing ? PERCUSS_RESULT_PENDING : PERCUSS_RESULT_OK;
}

/* A question of the batch without an answer of its own. */
static struct percuss_reply unanswered(const struct batch *batch)
{
    struct percuss_reply reply = {.status = batch->status};
    memcpy(reply.server, batch->server, sizeof reply.server);
    memcpy(reply.message, batch->message, sizeof reply.message);
    if (reply.status == PERCUSS_OK) {
        reply.status = PERCUSS_INTERNAL;
        snprintf(reply.message, sizeof reply.message,
                 "the server's batch reply has no answer to this request");
    }
    return reply;
}

void batch_collect(struct batch *batch, struct percuss_reply *replies, size_t count)
{
    size_t filled = 0;
    for (uint32_t i = 0; i < batch->parts; i++) {
        struct batch_part *part = &batch->part[i];
        for (size_t j = 0; j < part->count && filled < count; j++) {
            replies[filled++] = part->replies[j];
            part->replies[j] = (struct percuss_reply){0};
        }
    }
    while (filled < count)
        replies[filled++] = unanswered(batch);
}

void batch_clear(struct batch *batch)
{
    for (uint32_t i = 0; i < batch->parts; i++) {
        for (size_t j = 0; j < batch->part[i].count; j++)
            percuss_reply_free(&batch->part[i].replies[j]);
        free(batch->part[i].replies);
    }
    free(batch->part);
    *batch = (struct batch){0};
}
