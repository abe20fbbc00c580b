/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/database.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Each dent has the members of struct dent as columns, in its order. The mark of a client is the
 * highest number among its dropped replies. A checksum covers all other columns of its row; that of
 * a specimen covers its dents, too. */
static const char SCHEMA_NEW[] =
    "CREATE TABLE specimens (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE,"
    " body TEXT NOT NULL, nature TEXT NOT NULL, impacts INTEGER NOT NULL,"
    " checksum BLOB);"
    "CREATE TABLE dents (specimen INTEGER NOT NULL REFERENCES specimens ON DELETE CASCADE,"
    " number INTEGER NOT NULL, x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,"
    " size REAL NOT NULL, max_indentation REAL NOT NULL, max_force REAL NOT NULL,"
    " residual REAL NOT NULL, contact_radius REAL NOT NULL,"
    " PRIMARY KEY (specimen, number)) WITHOUT ROWID;"
    "CREATE TABLE replies (id INTEGER PRIMARY KEY AUTOINCREMENT, client BLOB NOT NULL,"
    " sequence INTEGER NOT NULL, content BLOB NOT NULL, reply BLOB NOT NULL, checksum BLOB,"
    " UNIQUE (client, sequence));"
    "CREATE TABLE marks (client BLOB PRIMARY KEY, sequence INTEGER NOT NULL,"
    " checksum BLOB) WITHOUT ROWID;";

/* The upgrade fills the new columns with checksums before it commits. */
static const char *const SCHEMA_UPGRADES[] = {
    "ALTER TABLE replies ADD COLUMN checksum BLOB",
    "ALTER TABLE specimens ADD COLUMN checksum BLOB; ALTER TABLE marks ADD COLUMN checksum BLOB"};

static const char *const SCHEMA_STATEMENTS[STATEMENT_COUNT] = {
    [STATEMENT_BEGIN] = "BEGIN IMMEDIATE",
    [STATEMENT_COMMIT] = "COMMIT",
    [STATEMENT_ROLLBACK] = "ROLLBACK",
    [STATEMENT_SPECIMEN] = "SELECT id, name, body, nature, impacts, checksum FROM specimens"
                           " WHERE name = ?1",
    [STATEMENT_DENTS] = "SELECT x, y, z, size, max_indentation, max_force, residual, contact_radius"
                        " FROM dents WHERE specimen = ?1 ORDER BY number",
    [STATEMENT_DENT_COUNT] = "SELECT count(*) FROM dents WHERE specimen = ?1",
    [STATEMENT_HIT] = "INSERT INTO specimens (name, body, nature, impacts) VALUES (?1, ?2, ?3, 1)"
                      " ON CONFLICT (name) DO UPDATE SET impacts = impacts + 1"
                      " RETURNING id, name, body, nature, impacts",
    [STATEMENT_SEAL] = "UPDATE specimens SET checksum = ?2 WHERE id = ?1",
    [STATEMENT_SMOOTH] = "DELETE FROM dents WHERE specimen = ?1",
    [STATEMENT_DENT] = "INSERT INTO dents VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)",
    [STATEMENT_KEEP] = "INSERT INTO replies (client, sequence, content, reply, checksum)"
                       " VALUES (?1, ?2, ?3, ?4, ?5)",
    [STATEMENT_OLDEST] = "SELECT id, client, sequence FROM replies ORDER BY id LIMIT 1",
    [STATEMENT_DROP] = "DELETE FROM replies WHERE id = ?1",
    [STATEMENT_MARK] = "INSERT INTO marks (client, sequence, checksum) VALUES (?1, ?2, ?3)"
                       " ON CONFLICT (client) DO UPDATE SET sequence = ?2, checksum = ?3",
    [STATEMENT_MARKED] = "SELECT client, sequence, checksum FROM marks WHERE client = ?1",
    [STATEMENT_REPLY] = "SELECT client, sequence, content, reply, checksum FROM replies"
                        " WHERE client = ?1 AND sequence = ?2",
    [STATEMENT_REPLIES] = "SELECT client, sequence, content, reply, checksum, id FROM replies"
                          " ORDER BY id",
    [STATEMENT_SEAL_REPLY] = "UPDATE replies SET checksum = ?2 WHERE id = ?1",
    [STATEMENT_MARKS] = "SELECT client, sequence, checksum FROM marks",
    [STATEMENT_LIST] = "SELECT id, name, body, nature, impacts, checksum FROM specimens"
                       " WHERE ?1 IS NULL OR name = ?1 ORDER BY name",
    [STATEMENT_CLEAR] = "DELETE FROM specimens WHERE name = ?1",
    [STATEMENT_COUNTS] = "SELECT (SELECT count(*) FROM specimens), (SELECT count(*) FROM replies)",
};

/* SQLite writes the write-ahead log back into the file from 256 pages on, and cuts it to 1 MiB: if
 * the log filled the volume, there would be no room to write it back. */
static const char BOUND_LOG[] = "PRAGMA wal_autocheckpoint = 256;"
                                "PRAGMA journal_size_limit = 1048576";

static const int BUSY_MILLISECONDS = 2000; /* a killed daemon's lock goes with its process */

static enum percuss_status database_refuse(struct database *database, const char *problem,
                                           struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s", database->path, problem);
}

/* The system's error of the last operation that failed on the log or else on the file; 0: none.
 * sqlite3_system_errno does not tell those of a COMMIT. */
static int system_error(struct database *database)
{
    sqlite3_file *log = NULL;
    int reason = 0;
    sqlite3_file_control(database->connection, "main", SQLITE_FCNTL_JOURNAL_POINTER, &log);
    if (log && log->pMethods)
        log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &reason);
    if (reason == 0)
        sqlite3_file_control(database->connection, "main", SQLITE_FCNTL_LAST_ERRNO, &reason);
    return reason;
}

/* Fills in PREFIX: SQLite's message, and the system's: "disk I/O error" alone does not tell a
 * broken disk from a read-only one, and SQLite calls a file malformed that the disk does not
 * return. */
static void describe(struct database *database, const char *prefix, char *text, size_t size)
{
    int code = sqlite3_errcode(database->connection) & 0xff;
    bool fails = code == SQLITE_IOERR || code == SQLITE_CORRUPT;
    const char *says = sqlite3_errmsg(database->connection);
    int reason = fails ? system_error(database) : 0;
    if (reason)
        snprintf(text, size, "%s: %s: %s", prefix, says, strerror(reason));
    else
        snprintf(text, size, "%s: %s", prefix, says);
}

enum percuss_status database_fault(struct database *database, const char *subject,
                                   struct fault *fault)
{
    char problem[320];
    describe(database, subject, problem, sizeof problem);
    return fault_set(fault, PERCUSS_INTERNAL, "%s: %s", database->path, problem);
}

static bool lacks_room(struct database *database)
{
    int code = sqlite3_errcode(database->connection) & 0xff;
    int reason = sqlite3_system_errno(database->connection);
    return code == SQLITE_FULL || ((code == SQLITE_IOERR || code == SQLITE_CANTOPEN) &&
                                   (reason == ENOSPC || reason == EDQUOT));
}

/* Refuses a file with SQLite's last error. */
static enum percuss_status database_refuse_file(struct database *database, struct fault *fault)
{
    char problem[320];
    if (!database->connection || sqlite3_errcode(database->connection) == SQLITE_NOMEM)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", database->path);
    if (sqlite3_errcode(database->connection) == SQLITE_BUSY)
        return database_refuse(database, "is in use by another process", fault);
    if (lacks_room(database))
        return fault_set(fault, PERCUSS_BUSY, "%s: cannot be made or brought up to date: no room",
                         database->path);
    describe(database, "cannot be used as a store of specimens", problem, sizeof problem);
    return database_refuse(database, problem, fault);
}

static bool database_execute(struct database *database, const char *text)
{
    return sqlite3_exec(database->connection, text, NULL, NULL, NULL) == SQLITE_OK;
}

/* The integer that a query returns; false: none. */
static bool query_number(struct database *database, const char *text, int *number)
{
    sqlite3_stmt *statement = NULL;
    bool good = sqlite3_prepare_v2(database->connection, text, -1, &statement, NULL) == SQLITE_OK &&
                sqlite3_step(statement) == SQLITE_ROW;
    if (good)
        *number = sqlite3_column_int(statement, 0);
    return sqlite3_finalize(statement) == SQLITE_OK && good;
}

/* Whether tables and indices agree and no page is lost. False: the check cannot run. */
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

/* Writes our application id and the schema's version into the file. */
static bool mark_version(struct database *database, int version)
{
    char text[96];
    snprintf(text, sizeof text, "PRAGMA application_id = %d; PRAGMA user_version = %d",
             DATABASE_APPLICATION, version);
    return database_execute(database, text);
}

static bool prepare_statements(struct database *database)
{
    bool good = true;
    for (int i = 0; good && i < STATEMENT_COUNT; i++)
        if (!database->statements[i])
            good = sqlite3_prepare_v3(database->connection, SCHEMA_STATEMENTS[i], -1,
                                      SQLITE_PREPARE_PERSISTENT, &database->statements[i],
                                      NULL) == SQLITE_OK;
    return good;
}

/* Upgrades a file of ours from that version to the newest. */
static enum percuss_status upgrade_schema(struct database *database, database_fill *fill,
                                          int version, struct fault *fault)
{
    char problem[160];
    if (version < 1 || version > SCHEMA_VERSION) {
        snprintf(problem, sizeof problem, "is of version %d: must be of version 1 to %d", version,
                 SCHEMA_VERSION);
        return database_refuse(database, problem, fault);
    }
    bool good = true;
    for (int v = version; good && v < SCHEMA_VERSION; v++)
        good = database_execute(database, SCHEMA_UPGRADES[v - 1]);
    good = good && mark_version(database, SCHEMA_VERSION) && prepare_statements(database);
    return good && fill(database) ? PERCUSS_OK : database_refuse_file(database, fault);
}

static enum percuss_status check_schema(struct database *database, database_fill *fill,
                                        struct fault *fault)
{
    int application, version, tables;
    bool whole;
    /* application id, version and integrity */
    if (!query_number(database, "PRAGMA application_id", &application) ||
        !query_number(database, "PRAGMA user_version", &version) ||
        !query_number(database, "SELECT count(*) FROM sqlite_master", &tables) ||
        !is_whole(database, &whole))
        return database_refuse_file(database, fault);
    if (!whole)
        return database_refuse(database, "is damaged: restore it from a copy or move it away",
                               fault);
    /* ours: use it, or upgrade it */
    if (application == DATABASE_APPLICATION && version == SCHEMA_VERSION)
        return PERCUSS_OK;
    if (application == DATABASE_APPLICATION)
        return upgrade_schema(database, fill, version, fault);
    /* refuse another program's; make an empty one ours */
    if (application != 0 || tables != 0)
        return database_refuse(database, "is a database of another program", fault);
    return database_execute(database, SCHEMA_NEW) && mark_version(database, SCHEMA_VERSION)
               ? PERCUSS_OK
               : database_refuse_file(database, fault);
}

/* One transaction checks and makes the schema. */
static enum percuss_status set_up(struct database *database, database_fill *fill,
                                  struct fault *fault)
{
    if (!database_execute(database, "PRAGMA locking_mode = EXCLUSIVE; PRAGMA synchronous = FULL;"
                                    "PRAGMA foreign_keys = ON; BEGIN EXCLUSIVE"))
        return database_refuse_file(database, fault);
    enum percuss_status status = check_schema(database, fill, fault);
    /* the journal mode is stored in the file: not in that of another program */
    if (!status && !(database_execute(database, "COMMIT; PRAGMA journal_mode = WAL") &&
                     database_execute(database, BOUND_LOG)))
        status = database_refuse_file(database, fault);
    return status;
}

/* SQLite opens a file that it may not write for reading; locks fail then for another reason. */
static enum percuss_status refuse_read_only(struct database *database, const char *path,
                                            struct fault *fault)
{
    char problem[160];
    int reason = access(path, W_OK) != 0 ? errno : EACCES;
    snprintf(problem, sizeof problem, "cannot be written: %s", strerror(reason));
    return database_refuse(database, problem, fault);
}

enum percuss_status database_open(struct database *database, const char *path, database_fill *fill,
                                  struct fault *fault)
{
    size_t length = strlen(path), most = sizeof database->path - 1;
    snprintf(database->path, sizeof database->path, "%s",
             length > most ? path + length - most : path);
    int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
    if (sqlite3_open_v2(path, &database->connection, flags, NULL) != SQLITE_OK)
        return database_refuse_file(database, fault);
    if (sqlite3_db_readonly(database->connection, "main") == 1)
        return refuse_read_only(database, path, fault);
    sqlite3_busy_timeout(database->connection, BUSY_MILLISECONDS);
    enum percuss_status status = set_up(database, fill, fault);
    if (!status && !prepare_statements(database))
        status = database_refuse_file(database, fault);
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
    /* an open statement would keep its lock; after a failure its message is still needed */
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
    const void *stored = sqlite3_column_blob(row, column);
    return stored && sqlite3_column_bytes(row, column) == sizeof *sum &&
           memcmp(stored, sum, sizeof *sum) == 0;
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
    /* all pages in one step: no other process uses the store meanwhile */
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
