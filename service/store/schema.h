/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The tables of a store of specimens, how older files come to have them, and the statements. */
#ifndef PERCUSS_STORE_SCHEMA_H
#define PERCUSS_STORE_SCHEMA_H

enum { SCHEMA_VERSION = 3 };

extern const char schema_new[];               /* makes the tables */
extern const char *const schema_upgrades[];   /* [v - 1] makes version v + 1 of version v */
extern const char *const schema_statements[]; /* [STATEMENT_COUNT] */

#endif
