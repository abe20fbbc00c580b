/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact tables in memory, looked up by materials: laws scale with the surfaces' radius.
 * Tables are added and never removed, so that found curves stay valid; a lookup takes no lock. */
#ifndef PERCUSS_STORE_TABLE_STORE_H
#define PERCUSS_STORE_TABLE_STORE_H

#include <stdbool.h>
#include <stddef.h>

#include "contact/law_table.h"
#include "fe/indentation.h"

struct table_store;

struct table_store *table_store_create(void);     /* NULL: out of memory */
void table_store_free(struct table_store *store); /* NULL is allowed */

/* Called with the reason of each refused file. */
typedef void table_store_complaint(const struct fault *fault);

/* Takes FOLDER/family.json, where it exists and the store has no family yet; complains of a damaged
 * one and leaves it out. Call it for all folders before loading tables from any: the family
 * continues tables beyond their ends. True: the family is this folder's. */
bool table_store_load_family(struct table_store *store, const char *folder,
                             table_store_complaint *complain);

/* Takes every FOLDER/ *.json that is a table of this version, and the family as above unless that
 * was done before; complains of other files and leaves them out. *count becomes the number of
 * tables taken. BAD_REQUEST: the folder cannot be read. */
enum percuss_status table_store_load(struct table_store *store, const char *folder,
                                     table_store_complaint *complain, size_t *count,
                                     struct fault *fault);

/* From now on the other store's family, which must live as long, continues added tables beyond
 * their ends. */
void table_store_lend_family(struct table_store *store, const struct table_store *from);

/* Sets the advice that its source gives for missing tables; the texts must live as long. */
void table_store_advise(struct table_store *store, const struct contact_table_remedy *remedy);

/* Adds one table, which the caller keeps. Any thread, also while others look up. BAD_REQUEST,
 * INTERNAL as table_curves_make. */
enum percuss_status table_store_add(struct table_store *store,
                                    const struct indentation_table *table, struct fault *fault);

/* The curves of two materials, in either order; NULL: none. Of several tables the deepest one, then
 * that of the smallest error, in any order of loading. */
const struct contact_curves *table_store_find(const struct table_store *store,
                                              const struct material *a, const struct material *b);

/* Whether a contact of these curvatures is one of surfaces of revolution: only those have
 * tables. */
bool table_store_is_circular(const double curvature[2]);

/* The solver's view of the store, with the family; valid as long as the store. */
const struct contact_table_source *table_store_source(struct table_store *store);

#endif
