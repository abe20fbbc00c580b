/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A request without a question: an answer shows that the server is there. */
#ifndef PERCUSS_LIB_PING_H
#define PERCUSS_LIB_PING_H

#include "client.h"

/* s between two pings: one that is written before both ends know each other is lost */
#define PING_INTERVAL 5e-3

/* Pings the server of that id; NULL: all. The lock is held. */
enum percuss_result ping_write(struct percuss_client *client, const uint8_t *server);

#endif
