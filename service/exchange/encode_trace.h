/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Time histories on the wire, cut into samples of bounded size. */
#ifndef PERCUSS_EXCHANGE_ENCODE_TRACE_H
#define PERCUSS_EXCHANGE_ENCODE_TRACE_H

#include "exchange/answer.h"
#include "impact/trace.h"

/* Instants in one sample: nine columns of doubles in less than 64 KiB. */
enum { TRACE_PART_INSTANTS = 900 };

/* The room that encode_trace takes of an answer; 0 for NULL. */
size_t encode_trace_room(const struct trace *trace);

/* Fills answer->traces; nothing for NULL. */
void encode_trace(struct answer *answer, const struct envelope *envelope,
                  const struct trace *trace);

#endif
