/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The SQLite file of the store of specimens: its schema, upgrades and prepared statements. */
#ifndef PERCUSS_STORE_DATABASE_H
#define PERCUSS_STORE_DATABASE_H

#include <sqlite3.h>
#include <stdbool.h>

#include "base/fault.h"
#include "base/hash.h"

/* "prcs" marks a file as a store of percuss. */
enum { DATABASE_APPLICATION = 0x70726373 };

/* The version of the schema, stored in the file. */
enum { SCHEMA_VERSION = 3 };

enum statement {
    STATEMENT_BEGIN,
    STATEMENT_COMMIT,
    STATEMENT_ROLLBACK,
    STATEMENT_SPECIMEN,
    STATEMENT_DENTS,
    STATEMENT_DENT_COUNT,
    STATEMENT_HIT,
    STATEMENT_SEAL,
    STATEMENT_SMOOTH,
    STATEMENT_DENT,
    STATEMENT_KEEP,
    STATEMENT_OLDEST,
    STATEMENT_DROP,
    STATEMENT_MARK,
    STATEMENT_MARKED,
    STATEMENT_REPLY,
    STATEMENT_REPLIES,
    STATEMENT_SEAL_REPLY,
    STATEMENT_MARKS,
    STATEMENT_LIST,
    STATEMENT_CLEAR,
    STATEMENT_COUNTS,
    STATEMENT_COUNT
};

/* Findings of a check. */
struct audit {
    void (*complain)(void *context, const char *problem);
    void *context;
    bool structure;                   /* check the structure, too, which opening has checked */
    size_t specimens, replies, marks; /* that were checked */
    size_t damaged;                   /* complaints */
    bool unusable;                    /* the file must not be used: earlier answers are unknown */
};

struct database {
    sqlite3 *connection;
    sqlite3_stmt *statements[STATEMENT_COUNT];
    char path[256]; /* cut to its end, for messages */
};

/* Writes the checksums that an upgrade by SQL alone cannot; false: it failed. */
typedef bool database_fill(struct database *database);

/* Opens the file, upgrades one of an older version, or creates it; locks out other processes,
 * checks that it is ours and whole, and prepares the statements. PERCUSS_BUSY: there is no room to
 * create or upgrade it. The caller calls database_close even after a failure. */
enum percuss_status database_open(struct database *database, const char *path, database_fill *fill,
                                  struct fault *fault);
void database_close(struct database *database);

/* Complains of each flaw in the structure: indices, pages, free space. False: it cannot be read. */
bool database_audit(struct database *database, struct audit *audit);

/* Copies the whole file, in its state between two transactions, to an empty one and syncs it to the
 * disk; that path must have no links. PERCUSS_INTERNAL with the reason; the caller removes the copy
 * then. */
enum percuss_status database_copy(struct database *database, const char *path, struct fault *fault);

/* Whether a column equals that checksum. */
bool database_matches(sqlite3_stmt *row, int column, const struct digest *sum);

/* The statement, reset and without bindings. */
sqlite3_stmt *database_statement(struct database *database, enum statement statement);

/* Runs a statement that returns no rows. */
bool database_run(sqlite3_stmt *statement);

/* Rolls the transaction back, if one is open. */
void database_roll_back(struct database *database);

/* PERCUSS_INTERNAL with "FILE: subject: SQLite's message", and the system's where it failed. */
enum percuss_status database_fault(struct database *database, const char *subject,
                                   struct fault *fault);

#endif
