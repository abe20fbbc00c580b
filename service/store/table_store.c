/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_store.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "store/family_file.h"
#include "store/table_curves.h"
#include "store/table_file.h"
#include "store/table_key.h"

struct table_entry {
    struct table_entry *next;
    struct material materials[2];
    double depth; /* range over radius */
    double error;
    char key[TABLE_KEY_SIZE];
    struct contact_curves *curves;
};

struct table_store {
    _Atomic(struct table_entry *) first;
    struct contact_family *family;
    bool has_looked; /* has looked for a family */
    struct contact_table_source source;
};

bool table_store_is_circular(const double curvature[2])
{
    /* rounding of the poses' rotations */
    return curvature[0] > 0.0 && fabs(curvature[1] / curvature[0] - 1.0) < 1e-9;
}

static const struct contact_curves *find_pair(void *context, const struct contact_pair *pair)
{
    if (!table_store_is_circular(pair->curvature))
        return NULL;
    return table_store_find(context, pair->a, pair->b);
}

struct table_store *table_store_create(void)
{
    struct table_store *store = calloc(1, sizeof *store);
    if (!store)
        return NULL;
    store->source = (struct contact_table_source){.context = store, .find = find_pair};
    return store;
}

void table_store_free(struct table_store *store)
{
    if (!store)
        return;
    struct table_entry *entry = atomic_load(&store->first);
    while (entry) {
        struct table_entry *next = entry->next;
        contact_curves_free(entry->curves);
        free(entry);
        entry = next;
    }
    contact_family_free(store->family);
    free(store);
}

const struct contact_table_source *table_store_source(struct table_store *store)
{
    return &store->source;
}

void table_store_lend_family(struct table_store *store, const struct table_store *from)
{
    store->source.family = from->source.family;
}

void table_store_advise(struct table_store *store, const struct contact_table_remedy *remedy)
{
    store->source.remedy = *remedy;
}

static bool entry_is_of(const struct table_entry *entry, const struct material *a,
                        const struct material *b)
{
    const struct material *own = entry->materials;
    return (table_same_material(&own[0], a) && table_same_material(&own[1], b)) ||
           (table_same_material(&own[0], b) && table_same_material(&own[1], a));
}

static bool entry_is_better(const struct table_entry *entry, const struct table_entry *other)
{
    if (entry->depth != other->depth)
        return entry->depth > other->depth;
    if (entry->error != other->error)
        return entry->error < other->error;
    return strcmp(entry->key, other->key) < 0;
}

const struct contact_curves *table_store_find(const struct table_store *store,
                                              const struct material *a, const struct material *b)
{
    const struct table_entry *best = NULL;
    for (const struct table_entry *entry = atomic_load(&store->first); entry; entry = entry->next)
        if (entry_is_of(entry, a, b) && (!best || entry_is_better(entry, best)))
            best = entry;
    return best ? best->curves : NULL;
}

enum percuss_status table_store_add(struct table_store *store,
                                    const struct indentation_table *table, struct fault *fault)
{
    struct table_entry *entry = calloc(1, sizeof *entry);
    if (!entry)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status =
        table_curves_make(table, store->source.family, &entry->curves, fault);
    if (status) {
        free(entry);
        return status;
    }
    /* keys for lookup and preference */
    memcpy(entry->materials, table->input.materials, sizeof entry->materials);
    entry->depth = contact_curves_range(entry->curves) / table->input.radius;
    entry->error = table->force_error;
    table_key(&table->input, entry->key);
    /* one atomic step into the list: other threads look up meanwhile */
    entry->next = atomic_load(&store->first);
    while (!atomic_compare_exchange_weak(&store->first, &entry->next, entry)) {
    }
    return PERCUSS_OK;
}

static enum percuss_status load_one(struct table_store *store, const char *path,
                                    struct fault *fault)
{
    struct indentation_table table;
    struct fault reason;
    enum percuss_status status = table_file_load(path, &table, fault);
    if (status)
        return status;
    status = table_store_add(store, &table, &reason);
    if (status)
        fault_set(fault, status, "%.300s: %.300s", path, reason.text);
    indentation_table_free(&table);
    return status;
}

bool table_store_load_family(struct table_store *store, const char *folder,
                             table_store_complaint *complain)
{
    char path[TABLE_PATH_SIZE];
    struct fault reason;
    snprintf(path, sizeof path, "%s/" FAMILY_FILE_NAME, folder);
    store->has_looked = true;
    if (store->family || access(path, F_OK) != 0)
        return false;
    store->family = family_file_load(path, &reason);
    store->source.family = store->family;
    if (!store->family)
        complain(&reason);
    return store->family;
}

static int is_table_name(const struct dirent *entry)
{
    size_t length = strlen(entry->d_name);
    return entry->d_name[0] != '.' && length > 5 && strcmp(entry->d_name, FAMILY_FILE_NAME) != 0 &&
           strcmp(entry->d_name + length - 5, ".json") == 0;
}

enum percuss_status table_store_load(struct table_store *store, const char *folder,
                                     table_store_complaint *complain, size_t *count,
                                     struct fault *fault)
{
    struct dirent **names;
    *count = 0;
    int found = scandir(folder, &names, is_table_name, alphasort);
    if (found < 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be read: %s", folder,
                         strerror(errno));
    if (!store->has_looked)
        table_store_load_family(store, folder, complain);
    /* a damaged table is left out */
    for (int i = 0; i < found; i++) {
        char path[TABLE_PATH_SIZE];
        struct fault reason;
        snprintf(path, sizeof path, "%s/%s", folder, names[i]->d_name);
        if (load_one(store, path, &reason))
            complain(&reason);
        else
            ++*count;
        free(names[i]);
    }
    free(names);
    return PERCUSS_OK;
}
