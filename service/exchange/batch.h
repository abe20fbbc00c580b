/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The replies of a batch, cut into samples of bounded size. */
#ifndef PERCUSS_EXCHANGE_BATCH_H
#define PERCUSS_EXCHANGE_BATCH_H

#include "exchange/answer.h"
#include "solve/result.h"

/* Largest sample, and most sub-impacts listed per contact. */
enum { BATCH_PART_BYTES = 64 * 1024, BATCH_SUB_IMPACTS = 16 };

/* A bound of a reply's serialised size (XCDR2) from above, within some 10 %. */
size_t batch_reply_size(const percuss_v1_Reply *reply);

/* As encode_result, for a member of a batch: lists fewer sub-impacts where a part would not hold
 * the reply otherwise. */
struct answer *batch_encode_member(const struct envelope *envelope,
                                   const struct solve_result *result,
                                   const char (*tokens)[PERCUSS_ID_SIZE]);

/* One answer to the whole batch, which takes over the references to its `count` members (and the
 * array stays the caller's). NULL: out of memory, and the members are still the caller's. */
struct answer *batch_answer(const struct envelope *envelope, struct answer *const *members,
                            size_t count);

#endif
