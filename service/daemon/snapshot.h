/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Loaded catalogues. A reload makes a new snapshot; requests that are being answered keep theirs.
 */
#ifndef PERCUSS_DAEMON_SNAPSHOT_H
#define PERCUSS_DAEMON_SNAPSHOT_H

#include <pthread.h>

#include "base/fault.h"
#include "model/body.h"

struct snapshot {
    struct body_set *set;
    unsigned holders;
};

/* The snapshot in force. */
struct snapshots {
    pthread_mutex_t lock;
    struct snapshot *current;
};

/* Reads the first snapshot. Its status is the catalogue's. */
enum percuss_status snapshots_open(struct snapshots *snapshots, const char *path,
                                   struct fault *fault);
void snapshots_close(struct snapshots *snapshots);

/* Reads a new snapshot and puts it in force; *before, to be released by the caller, is the old one.
 * After a failure the old one stays and *before is NULL. */
enum percuss_status snapshots_reload(struct snapshots *snapshots, const char *path,
                                     struct snapshot **before, struct fault *fault);

/* The snapshot in force, kept until it is released. */
struct snapshot *snapshots_hold(struct snapshots *snapshots);
void snapshots_release(struct snapshots *snapshots, struct snapshot *snapshot);

#endif
