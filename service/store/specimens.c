/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/specimens.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "store/database.h"
#include "store/database_check.h"
#include "store/dents.h"
#include "store/nature.h"
#include "store/schema.h"

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

/* A specimen with a row; the texts are the row's. */
struct specimen_row {
    int64_t id;
    struct specimen specimen;
    const char *nature;
};

static struct digest checksum(const struct specimen_row *row)
{
    struct hasher hasher = {0};
    hash_text(&hasher, row->specimen.name);
    hash_text(&hasher, row->specimen.body);
    hash_text(&hasher, row->nature);
    hash_number(&hasher, row->specimen.impacts);
    dents_hash(&hasher, row->specimen.state);
    return hash_digest(&hasher);
}

/* What the row says, without dents; false: out of memory, or it is none of a specimen. */
static bool take_row(sqlite3_stmt *statement, struct specimen_row *row)
{
    *row = (struct specimen_row){
        .id = sqlite3_column_int64(statement, 0),
        .specimen = {.name = (const char *)sqlite3_column_text(statement, 1),
                     .body = (const char *)sqlite3_column_text(statement, 2),
                     .impacts = (uint64_t)sqlite3_column_int64(statement, 4)},
        .nature = (const char *)sqlite3_column_text(statement, 3),
    };
    return row->specimen.name && row->specimen.body && row->nature;
}

/* The row with its dents, for free(); BAD_REQUEST: it is not what was stored. */
static enum percuss_status take_specimen(struct specimen_store *store, sqlite3_stmt *statement,
                                         struct specimen_row *row, struct body_state **state,
                                         struct fault *fault)
{
    *state = NULL;
    if (!take_row(statement, row))
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", store->database.path);
    enum percuss_status status = dents_read(&store->database, row->id, state, fault);
    row->specimen.state = *state;
    if (status)
        return status;
    struct digest sum = checksum(row);
    if (database_matches(statement, 5, &sum))
        return PERCUSS_OK;
    free(*state);
    *state = NULL;
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%.63s: what the store holds of it is damaged: its checksum differs: the store "
        "must be restored from a copy, or the specimen be cleared",
        row->specimen.name);
}

static bool seal(struct database *database, int64_t id, const struct digest *sum)
{
    sqlite3_stmt *statement = database_statement(database, STATEMENT_SEAL);
    sqlite3_bind_int64(statement, 1, id);
    sqlite3_bind_blob(statement, 2, sum, sizeof *sum, SQLITE_STATIC);
    return database_run(statement);
}

/* Gives a checksum to what older files hold without. */
static bool fill(struct database *database)
{
    sqlite3_stmt *list = database_statement(database, STATEMENT_LIST);
    int found = SQLITE_ERROR;
    bool good = true;
    while (good && (found = sqlite3_step(list)) == SQLITE_ROW) {
        struct specimen_row row;
        struct body_state *state = NULL;
        good = take_row(list, &row) && !dents_read(database, row.id, &state, NULL);
        row.specimen.state = state;
        struct digest sum = good ? checksum(&row) : (struct digest){0, 0};
        good = good && seal(database, row.id, &sum);
        free(state);
    }
    sqlite3_reset(list);
    return good && found == SQLITE_DONE && replies_fill(database);
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
    static const struct database_design design = {SCHEMA_VERSION, schema_new, schema_upgrades, fill,
                                                  schema_statements};
    enum percuss_status status = database_open(&created->database, path, &design, fault);
    /* SQLite does not say that the folder is missing */
    if (status == PERCUSS_BAD_REQUEST && access(path, F_OK) != 0)
        (void)database_folder_check(path, fault);
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

/* Whether the row is of that body, as it is now. */
static enum percuss_status check_body(const struct specimen_row *row, const struct body *body,
                                      struct fault *fault)
{
    char nature[NATURE_SIZE];
    const char *name = row->specimen.name, *id = row->specimen.body;
    /* it was made of the body of this id */
    if (strcmp(id, body->id) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s: is a specimen of %s, not of %s: must be another name, or be cleared "
                         "first",
                         name, id, body->id);
    /* whose shape, size and material are what they were */
    nature_describe(body, nature);
    if (strcmp(row->nature, nature) == 0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s: is a specimen of another %s, whose shape, size or material was not that "
                     "of the catalogue now: must be another name, or be cleared first",
                     name, id);
}

/* PERCUSS_INTERNAL for a specimen that is damaged: nothing is wrong with the request. */
static enum percuss_status load_row(struct specimen_store *store, sqlite3_stmt *statement,
                                    const struct body *body, struct body_state **state,
                                    struct fault *fault)
{
    struct specimen_row row;
    if (take_specimen(store, statement, &row, state, fault))
        return PERCUSS_INTERNAL;
    enum percuss_status status = check_body(&row, body, fault);
    if (status) {
        free(*state);
        *state = NULL;
    }
    return status;
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
    /* known: whole and of the same body, with its dents */
    if (found == SQLITE_ROW)
        status = load_row(store, statement, body, state, fault);
    else if (found != SQLITE_DONE)
        status = database_fault(&store->database, "specimen", fault);
    else if (store->specimens >= SPECIMEN_STORE_MOST)
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "%s: is a new name and there are %d specimens: must be one of them, or "
                           "some be cleared first",
                           name, SPECIMEN_STORE_MOST);
    sqlite3_reset(statement);
    return status;
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
    struct specimen_row row;
    if (!take_row(hit, &row))
        return false;
    *created += row.specimen.impacts == 1;
    row.specimen.state = change->after;
    struct digest sum = checksum(&row);
    /* a RETURNING statement must run to its end */
    if (sqlite3_step(hit) != SQLITE_DONE)
        return false;
    sqlite3_reset(hit);
    /* its dents are those after the impact */
    return dents_write(&store->database, row.id, change->after) &&
           seal(&store->database, row.id, &sum);
}

enum percuss_status specimen_store_commit(struct specimen_store *store,
                                          const struct specimen_change *changes, size_t count,
                                          const struct stored_reply *reply, struct fault *fault)
{
    struct database *database = &store->database;
    size_t created = 0, kept = store->replies + (reply ? 1 : 0);
    /* impact and reply in one transaction */
    bool good = database_run(database_statement(database, STATEMENT_BEGIN));
    for (size_t i = 0; good && i < count; i++)
        good = write_change(store, &changes[i], &created);
    good = good && (!reply || replies_keep(database, reply));
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
    int found;
    sqlite3_bind_text(statement, 1, name, -1, SQLITE_STATIC);
    while ((found = sqlite3_step(statement)) == SQLITE_ROW) {
        /* each with its dents, lent to the visitor; a damaged one keeps nobody from the others */
        struct specimen_row row;
        struct body_state *state;
        status = take_specimen(store, statement, &row, &state, fault);
        if (status == PERCUSS_INTERNAL)
            break;
        row.specimen.damaged = status;
        row.specimen.state = state;
        visitor(context, &row.specimen);
        free(state);
        status = PERCUSS_OK;
    }
    /* stopped by an error of the database */
    if (!status && found != SQLITE_DONE)
        status = database_fault(&store->database, "specimens", fault);
    sqlite3_reset(statement);
    return status;
}

/* Complains of specimens that are not what was stored. False: they cannot be read. */
static bool audit_specimens(struct specimen_store *store, struct audit *audit)
{
    sqlite3_stmt *statement = database_statement(&store->database, STATEMENT_LIST);
    enum percuss_status status = PERCUSS_OK;
    int found = SQLITE_ERROR;
    for (; status != PERCUSS_INTERNAL && (found = sqlite3_step(statement)) == SQLITE_ROW;
         audit->specimens++) {
        struct specimen_row row;
        struct body_state *state;
        struct fault problem;
        status = take_specimen(store, statement, &row, &state, &problem);
        free(state);
        if (status != PERCUSS_BAD_REQUEST)
            continue;
        audit->complain(audit->context, problem.text);
        audit->damaged++;
    }
    sqlite3_reset(statement);
    return found == SQLITE_DONE;
}

enum percuss_status specimen_store_audit(struct specimen_store *store, struct audit *audit,
                                         struct fault *fault)
{
    struct database *database = &store->database;
    if ((audit->structure && !database_audit(database, audit)) || !audit_specimens(store, audit) ||
        !replies_audit(database, audit))
        return database_fault(database, "the check", fault);
    return PERCUSS_OK;
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

enum percuss_status specimen_store_copy(struct specimen_store *store, const char *path,
                                        struct fault *fault)
{
    return database_copy(&store->database, path, fault);
}
