/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The latches of pairs near each other. */
#ifndef PERCUSS_SLOW_PAIRS_H
#define PERCUSS_SLOW_PAIRS_H

#include "slow.h"

/* The pair of a contact, or NULL. */
struct pair *pairs_find(const struct percuss_slow *slow,
                        const struct percuss_slow_contact *contact);

/* Takes in the contacts of the present: new pairs are armed, pairs that are not there any more are
 * forgotten unless they are playing. False: no memory. */
bool pairs_take(struct percuss_slow *slow, size_t count,
                const struct percuss_slow_contact *contacts);

/* Moves the latches on, with the gap rates known. */
void pairs_update(struct percuss_slow *slow, double now);

/* Whether a contact in this state is due. */
bool pairs_is_due(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate);

#endif
