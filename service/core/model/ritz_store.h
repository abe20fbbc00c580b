/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Vibrations of boxes and cylinders (ritz.h), shared by threads: each is computed once, and cached
 * while a thread holds it or while there is room. */
#ifndef PERCUSS_MODEL_RITZ_STORE_H
#define PERCUSS_MODEL_RITZ_STORE_H

#include "model/ritz.h"

struct ritz_store;
struct ritz_box; /* one of it: a vibration, and its flexibility at some places */

/* A store that drops the oldest boxes that are not held once all take more than `bytes`. One takes
 * some 4 to 30 MB, a held one up to 110: in RITZ_STORE_BYTES the pilots of an ensemble of a varied
 * size or Poisson's ratio find theirs again. NULL: out of memory. */
struct ritz_store *ritz_store_create(size_t bytes);
enum { RITZ_STORE_BYTES = 256 << 20 };

/* One more owner. The last owner's free ends the store; by then every box must be released. NULL is
 * allowed in both. */
struct ritz_store *ritz_store_share(struct ritz_store *store);
void ritz_store_free(struct ritz_store *store);

/* The vibration of these proportions, to be released. The first thread to ask computes it; others
 * wait and ask their pace once a millisecond. Where the first one is stopped another one goes on
 * from the beginning. NULL: out of memory, or stopped by the pace. */
struct ritz_box *ritz_store_hold(struct ritz_store *store, const struct ritz_shape *shape,
                                 double poisson, struct pace *pace);
void ritz_store_release(struct ritz_store *store, struct ritz_box *box);

/* The vibration of a held box; and its ritz_flexibility, cached for the last places. */
const struct ritz *ritz_box_vibration(const struct ritz_box *box);
double ritz_box_flexibility(struct ritz_store *store, struct ritz_box *box, int axis, int side,
                            const double point[3]);

/* The same of ritz_tensor. False: out of memory. */
bool ritz_box_tensor(struct ritz_store *store, struct ritz_box *box, int axis, int side,
                     const double point[3], double tensor[6]);

/* Bytes of its vibrations. */
size_t ritz_store_bytes(struct ritz_store *store);

/* Number of vibrations computed so far. */
unsigned long ritz_store_computed(struct ritz_store *store);

#endif
