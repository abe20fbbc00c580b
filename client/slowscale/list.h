/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Which impulse at which contact belongs to what time. */
#ifndef PERCUSS_SLOW_LIST_H
#define PERCUSS_SLOW_LIST_H

#include "slow.h"

/* The entries of an episode, in the order in which they are applied: the reply's sub-impacts at the
 * centres of their forces, or without a reply the impulses of its contacts at its time. `total`:
 * all are applied at the episode's time. */
void list_make(struct episode *episode, const struct percuss_reply *reply, const double *impulse,
               bool total);

#endif
