/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Loaded catalogues. A reload makes a new edition; requests that are being answered keep theirs. */
#ifndef PERCUSS_DAEMON_EDITION_H
#define PERCUSS_DAEMON_EDITION_H

#include <pthread.h>

#include "base/fault.h"
#include "model/body.h"

struct edition {
    struct body_set *set;
    unsigned holders;
};

/* The edition in force. */
struct editions {
    pthread_mutex_t lock;
    struct edition *current;
};

/* Reads the first edition. Its status is the catalogue's. */
enum percuss_status editions_create(struct editions *editions, const char *path,
                                    struct fault *fault);
void editions_release(struct editions *editions);

/* Reads a new edition and puts it in force; *before, to be let go by the caller, is the old one.
 * After a failure the old one stays and *before is NULL. */
enum percuss_status editions_reload(struct editions *editions, const char *path,
                                    struct edition **before, struct fault *fault);

/* The edition in force, kept until it is let go. */
struct edition *editions_hold(struct editions *editions);
void editions_let_go(struct editions *editions, struct edition *edition);

#endif
