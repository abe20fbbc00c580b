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
enum { DATABASE_APPLICATION = 0x70726373, SCHEMA_VERSION = 3 };

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

/* What a check finds. */
struct audit {
    void (*complain)(void *context, const char *problem);
    void *context;
    bool structure;                   /* asked for, besides the rows: opening checks it */
    size_t specimens, replies, marks; /* that were looked at */
    size_t damaged;                   /* complaints */
    bool unusable; /* the file must not be used: nobody knows what was answered before */
};

struct database {
    sqlite3 *connection;
    sqlite3_stmt *statements[STATEMENT_COUNT];
    char path[256]; /* its end, for messages */
};

/* Writes the checksums that an upgrade by SQL alone cannot; false: it failed. */
typedef bool database_fill(struct database *database);

/* Opens the file, brings one of an older version up to date, or creates it; keeps other processes
 * out, checks that it is ours and whole, and prepares the statements. PERCUSS_BUSY: there is no
 * room to create it or to bring it up to date. database_close is due whatever came of it. */
enum percuss_status database_open(struct database *database, const char *path, database_fill *fill,
                                  struct fault *fault);
void database_close(struct database *database);

/* Complains of each flaw in the structure: indices, pages, free space. False: cannot be read. */
bool database_audit(struct database *database, struct audit *audit);

/* Copies the whole file, as it is between two transactions, to an empty one and has it on the disk;
 * no link may be in that path. PERCUSS_INTERNAL with what went wrong; the copy is to be removed
 * then. */
enum percuss_status database_copy(struct database *database, const char *path, struct fault *fault);

/* Whether a column is that checksum. */
bool database_matches(sqlite3_stmt *row, int column, const struct digest *sum);

/* The statement, rewound, with nothing bound. */
sqlite3_stmt *database_statement(struct database *database, enum statement statement);

/* Runs a statement that returns no rows. */
bool database_run(sqlite3_stmt *statement);

/* Undoes the transaction, if one is open. */
void database_roll_back(struct database *database);

/* PERCUSS_INTERNAL with "FILE: what: what SQLite says". */
enum percuss_status database_fault(struct database *database, const char *what,
                                   struct fault *fault);

#endif
