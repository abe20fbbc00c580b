/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact tables of a server or of a solver in a program. Those of the folder, loaded at start,
 * serve `auto` and `table`. Those computed since, because a request insisted on one, serve `table`
 * only, so that the answers to `auto` do not change while it runs; the folder keeps them for the
 * next start. */
#ifndef PERCUSS_RESPOND_TABLE_CACHE_H
#define PERCUSS_RESPOND_TABLE_CACHE_H

#include <stdatomic.h>
#include <stdbool.h>

#include "model/body.h"
#include "percuss_wire.h"
#include "respond/settings.h"
#include "store/table_store.h"

/* Receives messages about tables, in any thread that makes some. */
struct table_listener {
    table_store_complaint *left_out;
    void (*told)(bool warning, const char *text);
};

/* For any thread: the stores only grow. */
struct table_cache {
    struct table_store *loaded, *made;
    char keep[SETTINGS_PATH_SIZE]; /* folder where those made go; empty: none */
    char *command, *then;          /* remedy of tables that are missing */
    const struct table_listener *listener;
    atomic_bool making; /* a thread computes a table: no other one does */
};

/* The folders that follow from settings, each once: their own ones, and beside them that of the
 * user's own tables and the shipped one, where these are there. A family is looked for in this
 * order. */
struct table_folders {
    char each[SETTINGS_FOLDERS_MOST + 2][SETTINGS_PATH_SIZE];
    size_t count;
};
void table_folders_find(struct table_folders *folders, const struct settings *settings);

/* Loads the folders of the settings; `listener` (borrowed; may be NULL) hears which tables are in
 * use, and which folders and files are refused. False: out of memory; release it all the same. */
bool table_cache_create(struct table_cache *cache, const struct settings *settings,
                        const struct table_listener *listener);
void table_cache_release(struct table_cache *cache);

/* The curves for `table`, or NULL. */
const struct contact_curves *table_cache_find(const struct table_cache *cache,
                                              const struct material *a, const struct material *b);

/* Whether `table` for a request would have to be computed first, as far as its bodies tell. */
bool table_cache_lacks(const struct table_cache *cache, const struct body_set *set,
                       const percuss_v1_Request *request);

/* Takes a table that took so many seconds to compute, for `table` and for the folder. The table
 * stays the caller's. Status as table_store_add. */
enum percuss_status table_cache_add(struct table_cache *cache,
                                    const struct indentation_table *table, double seconds,
                                    struct fault *fault);

#endif
