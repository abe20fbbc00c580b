/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specimens: durable objects whose dents outlive the daemon, with the replies that left them, in an
 * SQLite file (WAL, synchronous FULL). A reply and the dents it speaks of become durable together
 * or not at all. One process has the file open, one thread uses the store. */
#ifndef PERCUSS_STORE_SPECIMENS_H
#define PERCUSS_STORE_SPECIMENS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"
#include "contact/body_state.h"
#include "model/body.h"

struct audit;

/* Most specimens of a store. */
enum { SPECIMEN_STORE_MOST = 4096 };

struct specimen_store;

/* Opens or creates the file; `replies` >= 1 of the last requests are kept. PERCUSS_OK, or
 * PERCUSS_BAD_REQUEST with "FILE: ...": no store, damaged, of a newer version, used by another
 * process; PERCUSS_BUSY: the disk has no room to create it or to bring it up to date. */
enum percuss_status specimen_store_open(const char *path, unsigned replies,
                                        struct specimen_store **store, struct fault *fault);
void specimen_store_close(struct specimen_store *store); /* NULL is allowed */

/* The dents of a specimen as a body at rest that has them; NULL: none, or a new name. The caller
 * free()s it. PERCUSS_BAD_REQUEST: the name is that of another body, or the body has another shape,
 * size or material than when the specimen was first hit, or the store is full. PERCUSS_INTERNAL:
 * it cannot be read, or is not what was stored. */
enum percuss_status specimen_store_load(struct specimen_store *store, const char *name,
                                        const struct body *body, struct body_state **state,
                                        struct fault *fault);

/* One more impact on a specimen. Borrowed. */
struct specimen_change {
    const char *name;
    const struct body *body;
    const struct body_state *after; /* its dents are kept; NULL: none */
};

/* The reply to a request. */
struct stored_reply {
    uint8_t client[16];
    uint64_t sequence;
    uint64_t content[2]; /* hash of the request */
    size_t size;
    void *bytes;  /* in the form the caller chose */
    bool damaged; /* found, but not what was kept */
};

/* Makes the changes and the reply (NULL: none is kept) durable, in one transaction. After
 * PERCUSS_INTERNAL nothing has changed. */
enum percuss_status specimen_store_commit(struct specimen_store *store,
                                          const struct specimen_change *changes, size_t count,
                                          const struct stored_reply *reply, struct fault *fault);

/* The reply kept under reply->client and ->sequence: fills in the rest, and the caller free()s
 * ->bytes; NULL: there was no such request. PERCUSS_BAD_REQUEST: replies of that client with
 * numbers as high are no longer kept, so that nobody knows whether there was one. PERCUSS_INTERNAL:
 * with ->damaged what the file holds is not what was kept: its size or checksum differs; without,
 * it cannot be read now, or the mark of its client is damaged, and nobody knows whether there was
 * one. */
enum percuss_status specimen_store_find(struct specimen_store *store, struct stored_reply *reply,
                                        struct fault *fault);

/* A specimen as listed. Borrowed during the visit. */
struct specimen {
    const char *name;
    const char *body;               /* id */
    uint64_t impacts;               /* counted on it */
    const struct body_state *state; /* its dents; NULL: none */
    bool damaged;                   /* it is not what was stored: without dents */
};
typedef void specimen_visitor(void *context, const struct specimen *specimen);

/* Shows the specimen of that name, or with NULL all of them in the order of their names. */
enum percuss_status specimen_store_visit(struct specimen_store *store, const char *name,
                                         specimen_visitor *visitor, void *context,
                                         struct fault *fault);

/* Forgets a specimen, if there is one of that name: its dents and which body it is. Replies stay.
 */
enum percuss_status specimen_store_clear(struct specimen_store *store, const char *name,
                                         struct fault *fault);

/* Looks at everything in the store and complains of what is damaged: of specimens and replies,
 * which are refused when they are asked for, and of what makes it `unusable`. PERCUSS_INTERNAL: the
 * file cannot be read. */
enum percuss_status specimen_store_audit(struct specimen_store *store, struct audit *audit,
                                         struct fault *fault);

/* Copies the store, as it is now, to an empty file, in whose path no link may be. PERCUSS_INTERNAL:
 * what is there is no copy. */
enum percuss_status specimen_store_copy(struct specimen_store *store, const char *path,
                                        struct fault *fault);

/* Number of specimens. */
size_t specimen_store_count(const struct specimen_store *store);

#endif
