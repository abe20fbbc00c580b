/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests that name specimens: their dents come from the store, and the new dents are durable
 * together with the reply before any client sees it. One thread at a time; it takes the requests in
 * order of arrival. */
#ifndef PERCUSS_DAEMON_SPECIMEN_LANE_H
#define PERCUSS_DAEMON_SPECIMEN_LANE_H

#include "daemon/metrics.h"
#include "endpoint/endpoint.h"
#include "respond/responder.h"

struct specimen_lane;

/* Opens the store and logs the damage in it. Its status is specimen_store_open's;
 * PERCUSS_BAD_REQUEST too where it is damaged so that it must not be used. Where the disk has no
 * room to create it or to bring it up to date, the lane is there without it: it refuses requests
 * and opens the store when there is room. `path` is borrowed; `commits` notes how long writing
 * takes. */
enum percuss_status specimen_lane_open(const char *path, unsigned replies,
                                       struct histogram *commits, struct specimen_lane **lane,
                                       struct fault *fault);
void specimen_lane_close(struct specimen_lane *lane); /* NULL is allowed */

/* From now on the specimens are announced there. */
void specimen_lane_announce(struct specimen_lane *lane, struct endpoint *endpoint);

/* The reply to a request that names specimens: the stored one if there is one of this client and
 * number. NULL: out of memory. */
struct answer *specimen_lane_answer(struct specimen_lane *lane, struct responder *responder,
                                    const struct question *question);

/* Forgets a specimen. */
void specimen_lane_clear(struct specimen_lane *lane, const char *specimen);

/* Checks the whole store, logs the result, and copies it to that file (empty text: none). */
void specimen_lane_back_up(struct specimen_lane *lane, const char *path);

/* Checks a store that no daemon has open, or a copy, and logs the result. False: it is damaged or
 * there is none. */
bool specimen_lane_check_file(const char *path);

/* Number of specimens. Any thread. */
size_t specimen_lane_count(struct specimen_lane *lane);

/* Whether a request names a specimen. */
bool specimen_lane_concerns(const percuss_v1_Request *request);

#endif
