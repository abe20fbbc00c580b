/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specimens: durable objects with dents that outlive the daemon, and the replies that caused them,
 * in an SQLite file (WAL, synchronous FULL). One transaction makes a reply and its dents durable.
 * One process has the file open, one thread uses the store. */
#ifndef PERCUSS_STORE_SPECIMENS_H
#define PERCUSS_STORE_SPECIMENS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/fault.h"
#include "contact/body_state.h"
#include "model/body.h"

struct audit;

/* The largest number of specimens in a store. */
enum { SPECIMEN_STORE_MOST = 4096 };

struct specimen_store;

/* Opens or creates the file; `replies` >= 1 of the last requests are kept. PERCUSS_OK, or
 * PERCUSS_BAD_REQUEST with "FILE: ...": no store, damaged, of a newer version, used by another
 * process; PERCUSS_BUSY: the disk has no room to create it or to bring it up to date. */
enum percuss_status specimen_store_open(const char *path, unsigned replies,
                                        struct specimen_store **store, struct fault *fault);
void specimen_store_close(struct specimen_store *store); /* NULL is allowed */

/* The state of a body at rest with the specimen's dents; NULL: none, or a new name. The caller
 * free()s it. PERCUSS_BAD_REQUEST: the name is that of another body, or the body has another shape,
 * size or material than at the specimen's first impact, or the store is full. PERCUSS_INTERNAL: it
 * cannot be read, or its checksum differs. */
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
    void *bytes;  /* in the caller's encoding */
    bool damaged; /* found, but its size or checksum differs */
};

/* Makes the changes and the reply (NULL: none is kept) durable, in one transaction. After
 * PERCUSS_INTERNAL nothing has changed. */
enum percuss_status specimen_store_commit(struct specimen_store *store,
                                          const struct specimen_change *changes, size_t count,
                                          const struct stored_reply *reply, struct fault *fault);

/* Finds the reply to reply->client and ->sequence and fills in the rest; the caller free()s
 * ->bytes; NULL: there was no such request. PERCUSS_BAD_REQUEST: the number is not above those of
 * the client's dropped replies: whether there was a reply is unknown. PERCUSS_INTERNAL with
 * ->damaged: the size or checksum of the stored reply differs; without ->damaged: it cannot be read
 * now, or the mark of its client is damaged, so that it is unknown whether there was one. */
enum percuss_status specimen_store_find(struct specimen_store *store, struct stored_reply *reply,
                                        struct fault *fault);

/* A listed specimen. Borrowed during the visit. */
struct specimen {
    const char *name;
    const char *body;               /* id */
    uint64_t impacts;               /* number of impacts on it */
    const struct body_state *state; /* its dents; NULL: none */
    bool damaged;                   /* its checksum differs: without dents */
};
typedef void specimen_visitor(void *context, const struct specimen *specimen);

/* Calls the visitor with the specimen of that name, or (NULL) with all in the order of their
 * names. */
enum percuss_status specimen_store_visit(struct specimen_store *store, const char *name,
                                         specimen_visitor *visitor, void *context,
                                         struct fault *fault);

/* Deletes the specimen of that name, if there is one, with its dents. Replies stay. */
enum percuss_status specimen_store_clear(struct specimen_store *store, const char *name,
                                         struct fault *fault);

/* Checks all rows and complains of each damaged one: specimens and replies, which their own
 * requests will refuse, and marks, which make the store `unusable`. PERCUSS_INTERNAL: the file
 * cannot be read. */
enum percuss_status specimen_store_audit(struct specimen_store *store, struct audit *audit,
                                         struct fault *fault);

/* Copies the store in its present state to an empty file; that path must have no links.
 * PERCUSS_INTERNAL: the file is no good copy. */
enum percuss_status specimen_store_copy(struct specimen_store *store, const char *path,
                                        struct fault *fault);

/* Number of specimens. */
size_t specimen_store_count(const struct specimen_store *store);

#endif
