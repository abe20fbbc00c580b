/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The latches of pairs near each other. */
#ifndef PERCUSS_SLOW_PAIRS_H
#define PERCUSS_SLOW_PAIRS_H

#include "slow.h"

/* Whether two contacts are of the same bodies and feature, whichever body is called a: engines may
 * flip the order at any step. Impulse, rate and matrix are the same both ways, as the normal flips.
 */
bool pairs_is_same(const struct percuss_slow_contact *x, const struct percuss_slow_contact *y);

/* The pair of a contact, or NULL. */
struct pair *pairs_find(const struct percuss_slow *slow,
                        const struct percuss_slow_contact *contact);

/* Takes in the contacts of the present: new pairs are armed, pairs that are not there any more are
 * forgotten unless they are playing. False: no memory. */
bool pairs_take(struct percuss_slow *slow, size_t count,
                const struct percuss_slow_contact *contacts);

/* Sees how the gaps accelerated since their rates were last seen, whether that call ended well or
 * not, by the rates before any impulse of this one. */
void pairs_observe(struct percuss_slow *slow, size_t count,
                   const struct percuss_slow_contact *contacts, const double *gap_rate, double now);

/* The gaps as they are by now: impulses may have moved bodies since the engine was asked. */
void pairs_give_gaps(const struct percuss_slow *slow, size_t count,
                     struct percuss_slow_contact *contacts);

/* Moves the latches on, with the gap rates known. */
void pairs_update(struct percuss_slow *slow, double now);

/* Sees which pairs lie together, at the end of a call. */
void pairs_settle(struct percuss_slow *slow, double now);

/* The acceleration of a gap, m/s^2, as the engine states it or as the gap's rates showed it; 0
 * where it is not known. */
double pairs_acceleration(const struct percuss_slow *slow,
                          const struct percuss_slow_contact *contact);
bool pairs_knows_acceleration(const struct percuss_slow *slow,
                              const struct percuss_slow_contact *contact);

/* Approaches up to this speed are no impacts. */
double pairs_rest_speed(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                        double now);

/* Whether a contact in this state is due. */
bool pairs_is_due(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate, double now);

#endif
