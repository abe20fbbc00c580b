/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The contact tables at hand. Looked up by materials: laws scale with the surfaces' radius. Tables
 * come and never go, so that what was found stays valid; looking up takes no lock. */
#ifndef PERCUSS_STORE_TABLE_STORE_H
#define PERCUSS_STORE_TABLE_STORE_H

#include <stdbool.h>
#include <stddef.h>

#include "contact/law_table.h"
#include "fe/indentation.h"

struct table_store;

struct table_store *table_store_create(void);     /* NULL: out of memory */
void table_store_free(struct table_store *store); /* NULL is allowed */

/* Told what a file is refused for. */
typedef void table_store_complaint(const struct fault *fault);

/* Takes FOLDER/family.json, where it is there and the store has no family yet; a damaged one is
 * complained about and left out. To be called for all folders before a table is taken from any:
 * tables go on by the family beyond their ends. True: the family is this folder's. */
bool table_store_load_family(struct table_store *store, const char *folder,
                             table_store_complaint *complain);

/* Takes every FOLDER/ *.json that is a table of this version, and the family as above unless that
 * was called for; what is no sound table is complained about and left out. *count becomes the
 * number of tables taken. BAD_REQUEST: the folder cannot be read. */
enum percuss_status table_store_load(struct table_store *store, const char *folder,
                                     table_store_complaint *complain, size_t *count,
                                     struct fault *fault);

/* From now on tables added go on beyond their ends by the other store's family, which must live as
 * long. */
void table_store_lend_family(struct table_store *store, const struct table_store *from);

/* What its source tells of tables that it lacks; the texts must live as long. */
void table_store_advise(struct table_store *store, const struct contact_table_remedy *remedy);

/* Takes one table, which stays the caller's. Any thread, also while others look up. BAD_REQUEST,
 * INTERNAL as table_curves_make. */
enum percuss_status table_store_add(struct table_store *store,
                                    const struct indentation_table *table, struct fault *fault);

/* The curves of two materials, in either order; NULL: none. Of several tables the one that goes
 * deepest, then that of the smallest error, whatever the order they came in. */
const struct contact_curves *table_store_find(const struct table_store *store,
                                              const struct material *a, const struct material *b);

/* Whether a contact of these curvatures is one between surfaces of revolution: only those have
 * tables. */
bool table_store_is_circular(const double curvature[2]);

/* As the solver asks, with the family; valid as long as the store. */
const struct contact_table_source *table_store_source(struct table_store *store);

#endif
