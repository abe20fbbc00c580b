/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A series of impacts on specimens, of which each says what the store must hold after it. */
#ifndef PERCUSS_TEST_IMPACTS_H
#define PERCUSS_TEST_IMPACTS_H

#include "store/specimens.h"

enum {
    IMPACTS_KEPT = 8, /* replies that a store is to keep: old ones go and leave marks */
    IMPACTS_REPLY_MOST = 60000
};

/* The reply to an impact (1, 2, ...), of that size. Its bytes are valid until the next call. */
struct stored_reply impacts_reply(unsigned impact, size_t size);

/* Does the impact, as the daemon does. */
enum percuss_status impacts_hit(struct specimen_store *store, unsigned impact, size_t size,
                                struct fault *fault);

/* The number of impacts of a store. Fails the test unless every specimen has the dents of the last
 * of its. */
unsigned impacts_check(struct specimen_store *store);

/* After `count` impacts: fails the test unless the last replies are there to the last byte, those
 * before are known to have been, and no others. */
void impacts_check_replies(struct specimen_store *store, unsigned count, size_t size);

#endif
