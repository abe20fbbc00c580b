/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One question, from the wire's struct to a reply. */
#ifndef PERCUSS_LOCAL_ASKING_H
#define PERCUSS_LOCAL_ASKING_H

#include "gather.h"
#include "instance.h"

/* Answers a question whose client and sequence are set. TIMEOUT: the patience is over; NO_MEMORY.
 * `gather` NULL: histories are not wanted. */
enum percuss_result asking_answer(struct percuss_client *client, const percuss_v1_Request *wire,
                                  bool in_batch, double deadline, struct gather *gather,
                                  struct percuss_reply *reply);

/* Puts who asks and a number, drawn unless the request has one, on a converted request. */
void asking_address(struct percuss_client *client, uint64_t sequence, percuss_v1_Request *wire);

/* That a request was not answered in time. */
enum percuss_result asking_timeout(uint64_t sequence);

#endif
