/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The process that takes the place of a server that has gone: it answers under the same id. */
#ifndef PERCUSS_LIB_SUCCESSION_H
#define PERCUSS_LIB_SUCCESSION_H

#include "client.h"

/* Waits for a moment for the successor of a server that has gone, and stays with it; the lock is
 * held at entry and return. False: there is none. */
bool succession_follow(struct percuss_client *client, double deadline);

#endif
