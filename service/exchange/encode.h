/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The result of a solve, as a reply on the wire. */
#ifndef PERCUSS_EXCHANGE_ENCODE_H
#define PERCUSS_EXCHANGE_ENCODE_H

#include "exchange/answer.h"
#include "exchange/text.h"
#include "solve/result.h"

/* Instants in one sample of a time history: nine columns of doubles in less than 64 KiB. */
enum { TRACE_PART_INSTANTS = 900 };

/* The members that all kinds of replies begin with. */
#define ENCODE_HEAD(wire, envelope, state, text)                                                   \
    do {                                                                                           \
        memcpy((wire)->client, (envelope)->client, sizeof(wire)->client);                          \
        memcpy((wire)->server, (envelope)->server, sizeof(wire)->server);                          \
        (wire)->sequence = (envelope)->sequence;                                                   \
        COPY_TEXT((wire)->catalogue_revision, (envelope)->revision);                               \
        COPY_TEXT((wire)->version, (envelope)->version);                                           \
        (wire)->status = (state);                                                                  \
        COPY_TEXT((wire)->message, text);                                                          \
    } while (0)

/* A reply listing at most `listed` sub-impacts a contact (their count is exact all the same).
 * `tokens` names the state of every body afterwards, "" for none. Numbers the result does not
 * define, and all numbers of a refusal, are NaN. `timing` is zero. NULL: out of memory. */
struct answer *encode_result(const struct envelope *envelope, const struct solve_result *result,
                             const char (*tokens)[PERCUSS_ID_SIZE], size_t listed);

/* A reply with this status and nothing in it: a refusal, or the answer to a ping. */
struct answer *encode_refusal(const struct envelope *envelope, enum percuss_status status,
                              const char *message);

/* The head of every part of a batch's reply; a refused one has nothing else. */
void encode_batch_head(percuss_v1_BatchReply *part, const struct envelope *envelope,
                       enum percuss_status status, const char *message);

/* Refusals on the other topics of replies. */
struct answer *encode_batch_refusal(const struct envelope *envelope, enum percuss_status status,
                                    const char *message);
struct answer *encode_ensemble_refusal(const struct envelope *envelope, enum percuss_status status,
                                       const char *message);

/* Whether a status comes with results: the request was understood and computed. */
bool encode_status_has_result(enum percuss_status status);

#endif
