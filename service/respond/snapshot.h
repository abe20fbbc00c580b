/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The data that requests are answered from: a loaded catalogue, and the contact tables. A reload
 * makes a new snapshot; jobs that have begun keep theirs. All snapshots share the vibration of
 * blocks and cylinders (model/ritz_store.h). */
#ifndef PERCUSS_RESPOND_SNAPSHOT_H
#define PERCUSS_RESPOND_SNAPSHOT_H

#include <pthread.h>

#include "base/fault.h"
#include "model/body.h"
#include "respond/table_cache.h"

struct snapshot {
    struct body_set *set;
    struct table_cache *tables; /* borrowed: of all snapshots */
    unsigned holders;           /* under the lock of the snapshots */
};

/* The snapshot in force. */
struct snapshots {
    pthread_mutex_t lock;
    const char *folder;       /* of reduced bodies; NULL: none */
    struct snapshot *current; /* under the lock; NULL: none was read */
};

/* Has vibrations of blocks and cylinders take up to `boxes` bytes, and reads the first catalogue,
 * with reduced bodies from a folder (borrowed; empty: none). Its status is the catalogue's. */
enum percuss_status snapshots_open(struct snapshots *snapshots, size_t boxes, const char *path,
                                   struct table_cache *tables, const char *folder,
                                   struct fault *fault);
void snapshots_close(struct snapshots *snapshots);

/* Reads the catalogue again and puts it in force; *before, to be released by the caller, is the
 * snapshot until now. After a failure that one stays and *before is NULL. */
enum percuss_status snapshots_reload(struct snapshots *snapshots, const char *path,
                                     struct snapshot **before, struct fault *fault);

/* The snapshot in force, kept until it is released. */
struct snapshot *snapshots_hold(struct snapshots *snapshots);
void snapshots_release(struct snapshots *snapshots, struct snapshot *snapshot);

#endif
