/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests of specimens: their dents come from the store, and what an impact leaves is durable
 * together with its reply before anybody sees it. One thread at a time; it takes the requests in
 * order of arrival. */
#ifndef PERCUSS_DAEMON_RIG_H
#define PERCUSS_DAEMON_RIG_H

#include "daemon/respond.h"
#include "endpoint/endpoint.h"

struct rig;

/* Opens the store. Its status is specimen_store_open's. */
enum percuss_status rig_open(const char *path, unsigned replies, struct rig **rig,
                             struct fault *fault);
void rig_close(struct rig *rig); /* NULL is allowed */

/* From now on the specimens are announced there. */
void rig_announce(struct rig *rig, struct endpoint *endpoint);

/* The reply to a request that names specimens: the stored one if there is one of this client and
 * number. NULL: out of memory. */
struct answer *rig_respond(struct rig *rig, struct seat *seat, struct token_store *tokens,
                           const struct question *question);

/* Forgets a specimen. */
void rig_clear(struct rig *rig, const char *specimen);

/* Number of specimens. Any thread. */
size_t rig_count(struct rig *rig);

/* Whether a request names a specimen. */
bool rig_concerns(const percuss_v1_Request *request);

#endif
