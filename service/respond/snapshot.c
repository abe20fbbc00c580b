/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/snapshot.h"

#include <stdlib.h>

#include "catalogue/catalogue.h"
#include "model/ritz_store.h"

static enum percuss_status snapshot_load(const char *path, const char *folder,
                                         struct table_cache *tables, struct ritz_store *boxes,
                                         struct snapshot **snapshot, struct fault *fault)
{
    struct snapshot *loaded = calloc(1, sizeof *loaded);
    *snapshot = NULL;
    if (!loaded)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = catalogue_load_reducing(path, folder, &loaded->set, fault);
    if (status) {
        free(loaded);
        return status;
    }
    loaded->set->boxes = ritz_store_share(boxes);
    loaded->tables = tables;
    loaded->holders = 1;
    *snapshot = loaded;
    return PERCUSS_OK;
}

enum percuss_status snapshots_open(struct snapshots *snapshots, size_t bytes, const char *path,
                                   struct table_cache *tables, const char *folder,
                                   struct fault *fault)
{
    pthread_mutex_init(&snapshots->lock, NULL);
    snapshots->folder = folder[0] ? folder : NULL;
    struct ritz_store *boxes = ritz_store_create(bytes);
    enum percuss_status status =
        boxes ? snapshot_load(path, snapshots->folder, tables, boxes, &snapshots->current, fault)
              : fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    ritz_store_free(boxes);
    return status;
}

void snapshots_close(struct snapshots *snapshots)
{
    if (snapshots->current)
        snapshots_release(snapshots, snapshots->current);
    pthread_mutex_destroy(&snapshots->lock);
}

enum percuss_status snapshots_reload(struct snapshots *snapshots, const char *path,
                                     struct snapshot **before, struct fault *fault)
{
    struct snapshot *fresh;
    *before = NULL;
    const struct snapshot *current = snapshots->current;
    enum percuss_status status =
        snapshot_load(path, snapshots->folder, current->tables, current->set->boxes, &fresh, fault);
    if (status)
        return status;
    pthread_mutex_lock(&snapshots->lock);
    *before = snapshots->current;
    snapshots->current = fresh;
    pthread_mutex_unlock(&snapshots->lock);
    return PERCUSS_OK;
}

struct snapshot *snapshots_hold(struct snapshots *snapshots)
{
    pthread_mutex_lock(&snapshots->lock);
    struct snapshot *snapshot = snapshots->current;
    snapshot->holders++;
    pthread_mutex_unlock(&snapshots->lock);
    return snapshot;
}

void snapshots_release(struct snapshots *snapshots, struct snapshot *snapshot)
{
    pthread_mutex_lock(&snapshots->lock);
    bool last = --snapshot->holders == 0;
    pthread_mutex_unlock(&snapshots->lock);
    if (last) {
        body_set_free(snapshot->set);
        free(snapshot);
    }
}
