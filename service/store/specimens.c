/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/specimens.h"

#include <stdlib.h>
#include <string.h>

#include "store/database.h"
#include "store/nature.h"

/* So that no column is forgotten when a dent learns something new. */
_Static_assert(sizeof(struct dent) == 8 * sizeof(double), "dents have other columns");

/* The columns of a dent are those of struct dent, in its order. The mark of a client is the highest
 * number among its replies that are no longer kept. */
static const char schema[] =
    "CREATE TABLE specimens (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE,"
    " body TEXT NOT NULL, nature TEXT NOT NULL, impacts INTEGER NOT NULL);"
    "CREATE TABLE dents (specimen INTEGER NOT NULL REFERENCES specimens ON DELETE CASCADE,"
    " number INTEGER NOT NULL, x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,"
    " size REAL NOT NULL, max_indentation REAL NOT NULL, max_force REAL NOT NULL,"
    " residual REAL NOT NULL, contact_radius REAL NOT NULL,"
    " PRIMARY KEY (specimen, number)) WITHOUT ROWID;"
    "CREATE TABLE replies (id INTEGER PRIMARY KEY AUTOINCREMENT, client BLOB NOT NULL,"
    " sequence INTEGER NOT NULL, content BLOB NOT NULL, reply BLOB NOT NULL, checksum BLOB,"
    " UNIQUE (client, sequence));"
    "CREATE TABLE marks (client BLOB PRIMARY KEY, sequence INTEGER NOT NULL) WITHOUT ROWID;";

/* Replies that were kept before there were checksums have none. */
static const char *const upgrades[] = {"ALTER TABLE replies ADD COLUMN checksum BLOB"};

static const char *const texts[STATEMENT_COUNT] = {
    [STATEMENT_BEGIN] = "BEGIN IMMEDIATE",
    [STATEMENT_COMMIT] = "COMMIT",
    [STATEMENT_ROLLBACK] = "ROLLBACK",
    [STATEMENT_SPECIMEN] = "SELECT id, body, nature FROM specimens WHERE name = ?1",
    [STATEMENT_DENTS] = "SELECT x, y, z, size, max_indentation, max_force, residual, contact_radius"
                        " FROM dents WHERE specimen = ?1 ORDER BY number",
    [STATEMENT_DENT_COUNT] = "SELECT count(*) FROM dents WHERE specimen = ?1",
    [STATEMENT_HIT] = "INSERT INTO specimens (name, body, nature, impacts) VALUES (?1, ?2, ?3, 1)"
                      " ON CONFLICT (name) DO UPDATE SET impacts = impacts + 1"
                      " RETURNING id, impacts",
    [STATEMENT_SMOOTH] = "DELETE FROM dents WHERE specimen = ?1",
    [STATEMENT_DENT] = "INSERT INTO dents VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)",
    [STATEMENT_KEEP] = "INSERT INTO replies (client, sequence, content, reply, checksum)"
                       " VALUES (?1, ?2, ?3, ?4, ?5)",
    [STATEMENT_OLDEST] = "SELECT id, client, sequence FROM replies ORDER BY id LIMIT 1",
    [STATEMENT_DROP] = "DELETE FROM replies WHERE id = ?1",
    [STATEMENT_MARK] = "INSERT INTO marks VALUES (?1, ?2)"
                       " ON CONFLICT (client) DO UPDATE SET sequence = ?2",
    [STATEMENT_MARKED] = "SELECT sequence FROM marks WHERE client = ?1",
    [STATEMENT_REPLY] =
        "SELECT content, reply, checksum FROM replies WHERE client = ?1 AND sequence = ?2",
    [STATEMENT_LIST] = "SELECT id, name, body, impacts FROM specimens"
                       " WHERE ?1 IS NULL OR name = ?1 ORDER BY name",
    [STATEMENT_CLEAR] = "DELETE FROM specimens WHERE name = ?1",
    [STATEMENT_COUNTS] = "SELECT (SELECT count(*) FROM specimens), (SELECT count(*) FROM replies)",
};

struct specimen_store {
    struct database database;
    unsigned most_replies;
    size_t specimens, replies;
};

static enum percuss_status count_all(struct specimen_store *store, struct fault *fault)
{
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_COUNTS);
    if (sqlite3_step(statement) != SQLITE_ROW)
        return database_fault(&store->database, "counting", fault);
    store->specimens = (size_t)sqlite3_column_int64(statement, 0);
    store->replies = (size_t)sqlite3_column_int64(statement, 1);
    sqlite3_reset(statement);
    return PERCUSS_OK;
}

enum percuss_status specimen_store_open(const char *path, unsigned replies,
                                        struct specimen_store **store, struct fault *fault)
{
    struct specimen_store *created = calloc(1, sizeof *created);
    *store = NULL;
    if (!created)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    created->most_replies = replies;
    /* our file, and how much it holds */
    static const struct database_design design = {
        .version = SPECIMEN_STORE_VERSION, .schema = schema, .upgrades = upgrades, .texts = texts};
    enum percuss_status status = database_open(&created->database, path, &design, fault);
    if (!status)
        status = count_all(created, fault);
    if (status) {
        specimen_store_close(created);
        return status;
    }
    *store = created;
    return PERCUSS_OK;
}

void specimen_store_close(struct specimen_store *store)
{
    if (!store)
        return;
    database_close(&store->database);
    free(store);
}

size_t specimen_store_count(const struct specimen_store *store)
{
    return store->specimens;
}

/* Reads the dents of a specimen; *state NULL: none. */
static enum percuss_status read_dents(struct specimen_store *store, int64_t id,
                                      struct body_state **state, struct fault *fault)
{
    /* how many there are */
    sqlite3_stmt *counting = database_statement(&store->database, STATEMENT_DENT_COUNT);
    *state = NULL;
    sqlite3_bind_int64(counting, 1, id);
    if (sqlite3_step(counting) != SQLITE_ROW)
        return database_fault(&store->database, "dents", fault);
    struct body_state sizes = {.dents = (size_t)sqlite3_column_int64(counting, 0)};
    sqlite3_reset(counting);
    if (sizes.dents == 0)
        return PERCUSS_OK;
    if (sizes.dents > BODY_STATE_MAX_DENTS)
        return fault_set(fault, PERCUSS_INTERNAL, "%zu dents of one specimen: must be at most %d",
                         sizes.dents, BODY_STATE_MAX_DENTS);
    /* a state of that size */
    struct body_state *read = malloc(body_state_size(&sizes));
    if (!read)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    *read = sizes;
    /* their numbers, in the order of the struct */
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_DENTS);
    sqlite3_bind_int64(statement, 1, id);
    double *numbers = (double *)body_state_dents(read);
    size_t rows = 0;
    for (; rows < sizes.dents && sqlite3_step(statement) == SQLITE_ROW; rows++)
        for (int column = 0; column < 8; column++)
            *numbers++ = sqlite3_column_double(statement, column);
    if (rows < sizes.dents) {
        free(read);
        return database_fault(&store->database, "dents", fault);
    }
    sqlite3_reset(statement);
    *state = read;
    return PERCUSS_OK;
}

/* Whether the row is of that body, as it is now. */
static enum percuss_status check_body(sqlite3_stmt *row, const char *name, const struct body *body,
                                      struct fault *fault)
{
    char nature[NATURE_SIZE];
    const char *id = (const char *)sqlite3_column_text(row, 1);
    const char *known = (const char *)sqlite3_column_text(row, 2);
    if (!id || !known)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* it was made of the body of this id */
    if (strcmp(id, body->id) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s: is a specimen of %s, not of %s: must be another name, or be cleared "
                         "first",
                         name, id, body->id);
    /* whose shape, size and material are what they were */
    nature_describe(body, nature);
    if (strcmp(known, nature) == 0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s: is a specimen of another %s, whose shape, size or material was not that "
                     "of the catalogue now: must be another name, or be cleared first",
                     name, id);
}

enum percuss_status specimen_store_load(struct specimen_store *store, const char *name,
                                        const struct body *body, struct body_state **state,
                                        struct fault *fault)
{
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_SPECIMEN);
    *state = NULL;
    /* its row */
    sqlite3_bind_text(statement, 1, name, -1, SQLITE_STATIC);
    int found = sqlite3_step(statement);
    enum percuss_status status = PERCUSS_OK;
    /* known: of the same body, with its dents */
    if (found == SQLITE_ROW) {
        int64_t id = sqlite3_column_int64(statement, 0);
        status = check_body(statement, name, body, fault);
        if (!status)
            status = read_dents(store, id, state, fault);
    } else if (found != SQLITE_DONE) {
        status = database_fault(&store->database, "specimen", fault);
    } else if (store->specimens >= SPECIMEN_STORE_MOST) {
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "%s: is a new name and there are %d specimens: must be one of them, or "
                           "some be cleared first",
                           name, SPECIMEN_STORE_MOST);
    }
    sqlite3_reset(statement);
    return status;
}

static bool write_dent(struct specimen_store *store, int64_t id, size_t number,
                       const struct dent *dent)
{
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_DENT);
    const double *numbers = (const double *)dent;
    sqlite3_bind_int64(statement, 1, id);
    sqlite3_bind_int64(statement, 2, (int64_t)number);
    for (int column = 0; column < 8; column++)
        sqlite3_bind_double(statement, 3 + column, numbers[column]);
    return database_run(statement);
}

/* *created counts the names that are new. */
static bool write_change(struct specimen_store *store, const struct specimen_change *change,
                         size_t *created)
{
    char nature[NATURE_SIZE];
    nature_describe(change->body, nature);
    /* one impact more of the name, which is new maybe */
    sqlite3_stmt *hit = database_statement(&store->database, STATEMENT_HIT);
    sqlite3_bind_text(hit, 1, change->name, -1, SQLITE_STATIC);
    sqlite3_bind_text(hit, 2, change->body->id, -1, SQLITE_STATIC);
    sqlite3_bind_text(hit, 3, nature, -1, SQLITE_STATIC);
    if (sqlite3_step(hit) != SQLITE_ROW)
        return false;
    int64_t id = sqlite3_column_int64(hit, 0);
    *created += sqlite3_column_int64(hit, 1) == 1;
    /* a RETURNING statement must run to its end */
    if (sqlite3_step(hit) != SQLITE_DONE)
        return false;
    sqlite3_reset(hit);
    /* its dents are those after the impact */
    sqlite3_stmt *smooth = database_statement(&store->database, STATEMENT_SMOOTH);
    sqlite3_bind_int64(smooth, 1, id);
    bool good = database_run(smooth);
    size_t count = change->after ? change->after->dents : 0;
    for (size_t i = 0; good && i < count; i++)
        good = write_dent(store, id, i, &body_state_dents(change->after)[i]);
    return good;
}

enum percuss_status specimen_store_commit(struct specimen_store *store,
                                          const struct specimen_change *changes, size_t count,
                                          const struct stored_reply *reply, struct fault *fault)
{
    struct database *database = &store->database;
    size_t created = 0, kept = store->replies + 1;
    /* impact and reply in one transaction */
    bool good = database_run(database_statement(database, STATEMENT_BEGIN));
    for (size_t i = 0; good && i < count; i++)
        good = write_change(store, &changes[i], &created);
    good = good && replies_keep(database, reply);
    /* more than one where the limit was lowered */
    for (; good && kept > store->most_replies; kept--)
        good = replies_drop_oldest(database);
    good = good && database_run(database_statement(database, STATEMENT_COMMIT));
    if (good) {
        store->replies = kept;
        store->specimens += created;
        return PERCUSS_OK;
    }
    /* or nothing of all that */
    enum percuss_status status = database_fault(database, "the impact is not stored", fault);
    database_roll_back(database);
    return status;
}

enum percuss_status specimen_store_find(struct specimen_store *store, struct stored_reply *reply,
                                        struct fault *fault)
{
    return replies_find(&store->database, reply, fault);
}

enum percuss_status specimen_store_visit(struct specimen_store *store, const char *name,
                                         specimen_visitor *visitor, void *context,
                                         struct fault *fault)
{
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_LIST);
    enum percuss_status status = PERCUSS_OK;
    int found = SQLITE_DONE;
    sqlite3_bind_text(statement, 1, name, -1, SQLITE_STATIC);
    while (!status && (found = sqlite3_step(statement)) == SQLITE_ROW) {
        /* each with its dents, lent to the visitor */
        struct body_state *state;
        struct specimen specimen = {
            .name = (const char *)sqlite3_column_text(statement, 1),
            .body = (const char *)sqlite3_column_text(statement, 2),
            .impacts = (uint64_t)sqlite3_column_int64(statement, 3),
        };
        status = read_dents(store, sqlite3_column_int64(statement, 0), &state, fault);
        if (status)
            break;
        specimen.state = state;
        visitor(context, &specimen);
        free(state);
    }
    /* stopped by an error of the database */
    if (!status && found != SQLITE_DONE)
        status = database_fault(&store->database, "specimens", fault);
    sqlite3_reset(statement);
    return status;
}

enum percuss_status specimen_store_clear(struct specimen_store *store, const char *name,
                                         struct fault *fault)
{
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_CLEAR);
    sqlite3_bind_text(statement, 1, name, -1, SQLITE_STATIC);
    if (!database_run(statement))
        return database_fault(&store->database, "the specimen is not cleared", fault);
    store->specimens -= (size_t)sqlite3_changes(store->database.connection);
    return PERCUSS_OK;
}
