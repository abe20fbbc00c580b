/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_LIB_EXCHANGE_H
#define PERCUSS_LIB_EXCHANGE_H

#include "client.h"

/* NO_SERVER unless connected; the lock is held. */
enum percuss_result exchange_check_connected(const struct percuss_client *client);

/* Waits for a pending request that this thread has marked as waited for; the lock is held. OK: it
 * is ready; its own result is still to be looked at. */
enum percuss_result exchange_await(struct percuss_client *client, const struct pending *pending,
                                   double deadline);

/* Sends a request and waits for its reply, and with `gather` for its histories as well. */
enum percuss_result exchange_solve(struct percuss_client *client,
                                   const struct percuss_request *request, double deadline,
                                   struct gather *gather, struct percuss_reply *reply);

#endif
