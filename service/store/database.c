/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/database.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* The write-ahead log is written back into the file from 256 pages on, and cut to 1 MiB: a volume
 * that it fills has no room to write it back to. */
static const char BOUND_LOG[] = "PRAGMA wal_autocheckpoint = 256;"
                                "PRAGMA journal_size_limit = 1048576";

static const int BUSY_MILLISECONDS = 2000; /* a killed daemon's lock goes with its process */

static enum percuss_status refuse(struct database *database, const char *problem,
                                  struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", database->path, problem);
}

enum percuss_status database_fault(struct database *database, const char *what, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "%s: %s: %s", database->path, what,
                     sqlite3_errmsg(database->connection));
}

static bool lacks_room(struct database *database)
{
    int code = sqlite3_errcode(database->connection) & 0xff;
    int reason = sqlite3_system_errno(database->connection);
    return code == SQLITE_FULL || ((code == SQLITE_IOERR || code == SQLITE_CANTOPEN) &&
                                   (reason == ENOSPC || reason == EDQUOT));
}

/* What SQLite says about a file that cannot be used. */
static enum percuss_status refuse_file(struct database *database, struct fault *fault)
{
    char problem[320];
    if (!database->connection || sqlite3_errcode(database->connection) == SQLITE_NOMEM)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", database->path);
    if (sqlite3_errcode(database->connection) == SQLITE_BUSY)
        return refuse(database, "is in use by another process", fault);
    if (lacks_room(database))
        return fault_set(fault, PERCUSS_BUSY, "%s: cannot be made or brought up to date: no room",
                         database->path);
    snprintf(problem, sizeof problem, "cannot be used as a store of specimens: %s",
             sqlite3_errmsg(database->connection));
    return refuse(database, problem, fault);
}

static bool execute(struct database *database, const char *text)
{
    return sqlite3_exec(database->connection, text, NULL, NULL, NULL) == SQLITE_OK;
}

/* The whole number that a query gives; false: none. */
static bool query_number(struct database *database, const char *text, int *number)
{
    sqlite3_stmt *statement = NULL;
    bool good = sqlite3_prepare_v2(database->connection, text, -1, &statement, NULL) == SQLITE_OK &&
                sqlite3_step(statement) == SQLITE_ROW;
    if (good)
        *number = sqlite3_column_int(statement, 0);
    return sqlite3_finalize(statement) == SQLITE_OK && good;
}

/* Tables and indices say the same, and no page is lost. */
static bool is_whole(struct database *database, bool *whole)
{
    sqlite3_stmt *statement = NULL;
    bool good = sqlite3_prepare_v2(database->connection, "PRAGMA integrity_check(1)", -1,
                                   &statement, NULL) == SQLITE_OK &&
                sqlite3_step(statement) == SQLITE_ROW;
    const char *says = good ? (const char *)sqlite3_column_text(statement, 0) : NULL;
    *whole = says && strcmp(says, "ok") == 0;
    return sqlite3_finalize(statement) == SQLITE_OK && good;
}

/* Says in the file that it is ours, and of which version. */
static bool mark(struct database *database, int version)
{
    char text[96];
    snprintf(text, sizeof text, "PRAGMA application_id = %d; PRAGMA user_version = %d",
             DATABASE_APPLICATION, version);
    return execute(database, text);
}

static bool prepare(struct database *database, const struct database_design *design)
{
    bool good = true;
    for (int i = 0; good && i < STATEMENT_COUNT; i++)
        if (!database->statements[i])
            good = sqlite3_prepare_v3(database->connection, design->texts[i], -1,
                                      SQLITE_PREPARE_PERSISTENT, &database->statements[i],
                                      NULL) == SQLITE_OK;
    return good;
}

/* Brings a file of ours from that version up to date. */
static enum percuss_status upgrade(struct database *database, const struct database_design *design,
                                   int version, struct fault *fault)
{
    char problem[160];
    if (version < 1 || version > design->version) {
        snprintf(problem, sizeof problem, "is of version %d: must be of version 1 to %d", version,
                 design->version);
        return refuse(database, problem, fault);
    }
    bool good = true;
    for (int v = version; good && v < design->version; v++)
        good = execute(database, design->upgrades[v - 1]);
    good = good && mark(database, design->version) && prepare(database, design);
    return good && (!design->fill || design->fill(database)) ? PERCUSS_OK
                                                             : refuse_file(database, fault);
}

static enum percuss_status check_schema(struct database *database,
                                        const struct database_design *design, struct fault *fault)
{
    int application, version, tables;
    bool whole;
    /* whose file it is, of which version, and whether it is whole */
    if (!query_number(database, "PRAGMA application_id", &application) ||
        !query_number(database, "PRAGMA user_version", &version) ||
        !query_number(database, "SELECT count(*) FROM sqlite_master", &tables) ||
        !is_whole(database, &whole))
        return refuse_file(database, fault);
    if (!whole)
        return refuse(database, "is damaged: restore it from a copy or move it away", fault);
    /* ours, up to date or brought there */
    if (application == DATABASE_APPLICATION && version == design->version)
        return PERCUSS_OK;
    if (application == DATABASE_APPLICATION)
        return upgrade(database, design, version, fault);
    /* another program's, or an empty one that becomes ours */
    if (application != 0 || tables != 0)
        return refuse(database, "is a database of another program", fault);
    return execute(database, design->schema) && mark(database, design->version)
               ? PERCUSS_OK
               : refuse_file(database, fault);
}

/* The schema is looked at and made in one transaction. */
static enum percuss_status set_up(struct database *database, const struct database_design *design,
                                  struct fault *fault)
{
    if (!execute(database, "PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL;"
                           "PRAGMA foreign_keys = ON; BEGIN EXCLUSIVE"))
        return refuse_file(database, fault);
    enum percuss_status status = check_schema(database, design, fault);
    /* it is written into the file: not into that of another program */
    if (!status &&
        !(execute(database, "COMMIT; PRAGMA journal_mode = WAL") && execute(database, BOUND_LOG)))
        status = refuse_file(database, fault);
    return status;
}

enum percuss_status database_open(struct database *database, const char *path,
                                  const struct database_design *design, struct fault *fault)
{
    size_t length = strlen(path), most = sizeof database->path - 1;
    snprintf(database->path, sizeof database->path, "%s",
             length > most ? path + length - most : path);
    int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
    if (sqlite3_open_v2(path, &database->connection, flags, NULL) != SQLITE_OK)
        return refuse_file(database, fault);
    sqlite3_busy_timeout(database->connection, BUSY_MILLISECONDS);
    enum percuss_status status = set_up(database, design, fault);
    if (!status && !prepare(database, design))
        status = refuse_file(database, fault);
    return status;
}

void database_close(struct database *database)
{
    for (int i = 0; i < STATEMENT_COUNT; i++)
        sqlite3_finalize(database->statements[i]);
    sqlite3_close(database->connection);
}

sqlite3_stmt *database_statement(struct database *database, enum statement statement)
{
    sqlite3_stmt *prepared = database->statements[statement];
    sqlite3_reset(prepared);
    sqlite3_clear_bindings(prepared);
    return prepared;
}

bool database_run(sqlite3_stmt *statement)
{
    bool done = sqlite3_step(statement) == SQLITE_DONE;
    /* a statement left open would keep its lock; the message of a failure stays */
    if (done)
        sqlite3_reset(statement);
    return done;
}

void database_roll_back(struct database *database)
{
    for (int i = 0; i < STATEMENT_COUNT; i++)
        sqlite3_reset(database->statements[i]);
    if (!sqlite3_get_autocommit(database->connection))
        database_run(database->statements[STATEMENT_ROLLBACK]);
}

bool database_matches(sqlite3_stmt *row, int column, const struct digest *sum)
{
    const void *kept = sqlite3_column_blob(row, column);
    return kept && sqlite3_column_bytes(row, column) == sizeof *sum &&
           memcmp(kept, sum, sizeof *sum) == 0;
}

bool database_audit(struct database *database, struct audit *audit)
{
    sqlite3_stmt *statement = NULL;
    int found = SQLITE_ERROR;
    if (sqlite3_prepare_v2(database->connection, "PRAGMA integrity_check(20)", -1, &statement,
                           NULL) == SQLITE_OK)
        while ((found = sqlite3_step(statement)) == SQLITE_ROW) {
            const char *says = (const char *)sqlite3_column_text(statement, 0);
            if (!says || strcmp(says, "ok") == 0)
                continue;
            audit->complain(audit->context, says);
            audit->damaged++;
            audit->unusable = true;
        }
    return sqlite3_finalize(statement) == SQLITE_OK && found == SQLITE_DONE;
}

enum percuss_status database_copy(struct database *database, const char *path, struct fault *fault)
{
    sqlite3 *copy = NULL;
    sqlite3_backup *backup = NULL;
    int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOFOLLOW | SQLITE_OPEN_NOMUTEX;
    enum percuss_status status = PERCUSS_OK;
    /* all pages in one step: nobody else uses the store meanwhile */
    if (sqlite3_open_v2(path, &copy, flags, NULL) == SQLITE_OK)
        backup = sqlite3_backup_init(copy, "main", database->connection, "main");
    if (backup)
        sqlite3_backup_step(backup, -1);
    if (!backup || sqlite3_backup_finish(backup) != SQLITE_OK)
        status = fault_set(fault, PERCUSS_INTERNAL, "%.300s: cannot be written: %s", path,
                           copy ? sqlite3_errmsg(copy) : "out of memory");
    if (sqlite3_close(copy) != SQLITE_OK && !status)
        status = fault_set(fault, PERCUSS_INTERNAL, "%.300s: cannot be closed", path);
    return status;
}
