/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Answers being played, and revoked. */
#ifndef PERCUSS_SLOW_EPISODE_H
#define PERCUSS_SLOW_EPISODE_H

#include "group.h"

/* Latches the group's pairs and enters the impulses to be applied from its start on: by the group's
 * reply to `request`, or without one the group's impulses at once. */
enum percuss_result episode_begin(struct percuss_slow *slow, const struct group *group,
                                  const struct percuss_request *request);

/* Applies all entries up to now, and forgets episodes that were over before the step that ends now;
 * *applied counts the entries. */
enum percuss_result episodes_play(struct percuss_slow *slow, double now, size_t *applied);

/* The revocable episode that the contact is part of and whose window `time` is in, or NULL. */
struct episode *episode_of(const struct percuss_slow *slow,
                           const struct percuss_slow_contact *contact, double time);

/* The last time up to `time` at which none of its sub-impacts is under way. */
double episode_pause(const struct episode *episode, double time);

/* Revokes impulses after the group's start, takes back the applied ones, and asks for the vibration
 * at that time. Losses are noted in the group. */
enum percuss_result episode_revoke(struct percuss_slow *slow, struct episode *episode,
                                   struct group *group, double now);

/* Forgets the revoked episodes, once their successors are known. */
void episodes_drop_revoked(struct percuss_slow *slow);

/* Goes on with the revoked episodes, which have no successors: applies again the impulses taken
 * back. */
enum percuss_result episodes_restore_revoked(struct percuss_slow *slow, double now);

void episodes_free(struct percuss_slow *slow);

#endif
