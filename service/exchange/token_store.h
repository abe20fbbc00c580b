/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Immutable states of bodies by name. A token is a hash of catalogue revision, body and state:
 * equal states have equal tokens in every process and at every time. Thread-safe. */
#ifndef PERCUSS_EXCHANGE_TOKEN_STORE_H
#define PERCUSS_EXCHANGE_TOKEN_STORE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"
#include "contact/body_state.h"

/* Bounds of the store: it keeps the states used last, within all three. */
struct token_limits {
    size_t count;
    size_t bytes;
    double seconds; /* since the last use */
};

struct token_store;
struct token_store *token_store_create(const struct token_limits *limits); /* NULL: no memory */
void token_store_free(struct token_store *store); /* no state may be held any more */

/* The body that has the state. */
enum { TOKEN_BODY_SIZE = PERCUSS_ID_SIZE + 40 };
struct token_subject {
    const char *revision; /* of the catalogue */
    const char *body;     /* below TOKEN_BODY_SIZE: its id, and a hash of the request's overrides */
};

/* Keeps a copy of the state and writes its token; an empty one where another state has the same
 * hash. `now` is a monotonic time, s. False: out of memory. */
bool token_store_put(struct token_store *store, const struct token_subject *subject,
                     const struct body_state *state, double now, char token[PERCUSS_ID_SIZE]);

/* The state of that token, kept alive until token_store_release; NULL: unknown, expired, of another
 * body or of another catalogue, which the fault says. */
const struct body_state *token_store_hold(struct token_store *store, const char *token,
                                          const struct token_subject *subject, double now,
                                          struct fault *fault);
void token_store_release(struct token_store *store, const struct body_state *state);

/* Drops expired states. */
void token_store_sweep(struct token_store *store, double now);

/* Number of states that can be asked for, and their bytes. */
size_t token_store_count(struct token_store *store);
size_t token_store_bytes(struct token_store *store);

#endif
