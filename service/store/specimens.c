/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/specimens.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "store/database.h"
#include "store/database_check.h"

struct specimen_store {
    struct database database;
    unsigned most_replies;
    size_t specimens, replies;
};

/* ---- dents of a specimen ---- */

enum { DENT_COLUMNS = 8 };

/* A new member of struct dent needs a new column. */
_Static_assert(sizeof(struct dent) == DENT_COLUMNS * sizeof(double), "dents have other columns");

/* Reads the dents of the specimen with that row, for free(); *state NULL: none. */
static enum percuss_status dents_read(struct database *database, int64_t id,
                                      struct body_state **state, struct fault *fault)
{
    /* their number */
    sqlite3_stmt *counting = database_statement(database, STATEMENT_DENT_COUNT);
    *state = NULL;
    sqlite3_bind_int64(counting, 1, id);
    if (sqlite3_step(counting) != SQLITE_ROW)
        return database_fault(database, "dents", fault);
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
    /* a body at rest: all its modes are known */
    for (size_t f = 0; f < sizeof read->known / sizeof *read->known; f++)
        read->known[f] = SIZE_MAX;
    /* their numbers, in the order of the struct */
    sqlite3_stmt *statement = database_statement(database, STATEMENT_DENTS);
    sqlite3_bind_int64(statement, 1, id);
    double *numbers = (double *)body_state_dents(read);
    size_t rows = 0;
    for (; rows < sizes.dents && sqlite3_step(statement) == SQLITE_ROW; rows++)
        for (int column = 0; column < DENT_COLUMNS; column++)
            *numbers++ = sqlite3_column_double(statement, column);
    if (rows < sizes.dents) {
        free(read);
        return database_fault(database, "dents", fault);
    }
    sqlite3_reset(statement);
    *state = read;
    return PERCUSS_OK;
}

static bool write_dent(struct database *database, int64_t id, size_t number,
                       const struct dent *dent)
{
    sqlite3_stmt *statement = database_statement(database, STATEMENT_DENT);
    const double *numbers = (const double *)dent;
    sqlite3_bind_int64(statement, 1, id);
    sqlite3_bind_int64(statement, 2, (int64_t)number);
    for (int column = 0; column < DENT_COLUMNS; column++)
        sqlite3_bind_double(statement, 3 + column, numbers[column]);
    return database_run(statement);
}

/* Puts the dents of a state (NULL: none) in place of those that the specimen had; within the
 * caller's transaction. */
static bool dents_write(struct database *database, int64_t id, const struct body_state *state)
{
    sqlite3_stmt *smooth = database_statement(database, STATEMENT_SMOOTH);
    sqlite3_bind_int64(smooth, 1, id);
    bool good = database_run(smooth);
    size_t count = state ? state->dents : 0;
    for (size_t i = 0; good && i < count; i++)
        good = write_dent(database, id, i, &body_state_dents(state)[i]);
    return good;
}

/* Adds dents to a checksum as the store returns them: -0 becomes 0. */
static void dents_hash(struct hasher *hasher, const struct body_state *state)
{
    size_t count = state ? DENT_COLUMNS * state->dents : 0;
    const double *numbers = state ? (const double *)body_state_dents(state) : NULL;
    hash_number(hasher, count);
    for (size_t i = 0; i < count; i++) {
        double number = numbers[i] + 0.0;
        uint64_t bits;
        memcpy(&bits, &number, sizeof bits);
        hash_number(hasher, bits);
    }
}

/* ---- stored replies: the last ones, and the mark of each client: the highest number among its
 * dropped replies ---- */

enum { CLIENT_SIZE = 16 };

static struct digest mark_checksum(const void *client, uint64_t mark)
{
    struct hasher hasher = {0};
    hash_bytes(&hasher, client, CLIENT_SIZE);
    hash_number(&hasher, mark);
    return hash_digest(&hasher);
}

/* The mark in a row; false: its checksum differs. Sequences are unsigned, columns are signed. */
static bool take_mark(sqlite3_stmt *row, uint64_t *mark)
{
    *mark = (uint64_t)sqlite3_column_int64(row, 1);
    if (sqlite3_column_bytes(row, 0) != CLIENT_SIZE)
        return false;
    struct digest sum = mark_checksum(sqlite3_column_blob(row, 0), *mark);
    return database_matches(row, 2, &sum);
}

static enum percuss_status refuse_mark(struct database *database, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL,
                     "%s: the mark of a client is damaged: nobody knows which of its requests were "
                     "answered: restore the store from a copy",
                     database->path);
}

/* The mark of a client; 0: it has none. */
static enum percuss_status read_mark(struct database *database, const void *client, uint64_t *mark,
                                     struct fault *fault)
{
    sqlite3_stmt *statement = database_statement(database, STATEMENT_MARKED);
    enum percuss_status status = PERCUSS_OK;
    *mark = 0;
    sqlite3_bind_blob(statement, 1, client, CLIENT_SIZE, SQLITE_STATIC);
    int found = sqlite3_step(statement);
    if (found == SQLITE_ROW)
        status = take_mark(statement, mark) ? PERCUSS_OK : refuse_mark(database, fault);
    else if (found != SQLITE_DONE)
        status = database_fault(database, "stored replies", fault);
    sqlite3_reset(statement);
    return status;
}

static bool set_mark(struct database *database, const void *client, uint64_t mark)
{
    sqlite3_stmt *set = database_statement(database, STATEMENT_MARK);
    struct digest sum = mark_checksum(client, mark);
    sqlite3_bind_blob(set, 1, client, CLIENT_SIZE, SQLITE_STATIC);
    sqlite3_bind_int64(set, 2, (int64_t)mark);
    sqlite3_bind_blob(set, 3, &sum, sizeof sum, SQLITE_STATIC);
    return database_run(set);
}

/* Drops the reply that was stored first and sets the mark of its client; within the caller's
 * transaction. */
static bool replies_drop_oldest(struct database *database)
{
    uint8_t client[CLIENT_SIZE];
    uint64_t mark;
    sqlite3_stmt *oldest = database_statement(database, STATEMENT_OLDEST);
    /* the reply that was stored first */
    if (sqlite3_step(oldest) != SQLITE_ROW || sqlite3_column_bytes(oldest, 1) != CLIENT_SIZE)
        return false;
    int64_t id = sqlite3_column_int64(oldest, 0);
    memcpy(client, sqlite3_column_blob(oldest, 1), sizeof client);
    uint64_t sequence = (uint64_t)sqlite3_column_int64(oldest, 2);
    sqlite3_reset(oldest);
    sqlite3_stmt *drop = database_statement(database, STATEMENT_DROP);
    sqlite3_bind_int64(drop, 1, id);
    if (!database_run(drop) || read_mark(database, client, &mark, NULL))
        return false;
    /* its client's mark: replies up to that number are dropped */
    return sequence <= mark || set_mark(database, client, sequence);
}

/* Covers all columns of a row. */
static struct digest reply_checksum(const struct stored_reply *reply)
{
    struct hasher hasher = {0};
    hash_bytes(&hasher, reply->client, sizeof reply->client);
    hash_number(&hasher, reply->sequence);
    hash_bytes(&hasher, reply->content, sizeof reply->content);
    hash_bytes(&hasher, reply->bytes, reply->size);
    return hash_digest(&hasher);
}

/* Keeps a reply, with a checksum over its whole row; within the caller's transaction. */
static bool replies_keep(struct database *database, const struct stored_reply *reply)
{
    sqlite3_stmt *keep = database_statement(database, STATEMENT_KEEP);
    sqlite3_bind_blob(keep, 1, reply->client, sizeof reply->client, SQLITE_STATIC);
    sqlite3_bind_int64(keep, 2, (int64_t)reply->sequence);
    sqlite3_bind_blob(keep, 3, reply->content, sizeof reply->content, SQLITE_STATIC);
    sqlite3_bind_blob64(keep, 4, reply->bytes, reply->size, SQLITE_STATIC);
    struct digest sum = reply_checksum(reply);
    sqlite3_bind_blob(keep, 5, &sum, sizeof sum, SQLITE_STATIC);
    return database_run(keep);
}

/* Whether the columns of the row have the sizes of a reply's. */
static bool reply_is_shaped(sqlite3_stmt *row, const struct stored_reply *reply)
{
    return sqlite3_column_bytes(row, 0) == CLIENT_SIZE &&
           sqlite3_column_bytes(row, 2) == sizeof reply->content &&
           sqlite3_column_bytes(row, 3) > 0;
}

/* The row as a reply; its bytes point into the row. False: its sizes or checksum differ. */
static bool reply_read_row(sqlite3_stmt *row, struct stored_reply *reply)
{
    if (!reply_is_shaped(row, reply))
        return false;
    memcpy(reply->client, sqlite3_column_blob(row, 0), sizeof reply->client);
    reply->sequence = (uint64_t)sqlite3_column_int64(row, 1);
    memcpy(reply->content, sqlite3_column_blob(row, 2), sizeof reply->content);
    reply->size = (size_t)sqlite3_column_bytes(row, 3);
    reply->bytes = (void *)sqlite3_column_blob(row, 3);
    struct digest sum = reply_checksum(reply);
    return database_matches(row, 4, &sum);
}

static enum percuss_status reply_refuse_damaged(struct database *database,
                                                struct stored_reply *reply, struct fault *fault)
{
    reply->damaged = true;
    return fault_set(
        fault, PERCUSS_INTERNAL,
        "%s: the stored reply to request %llu is damaged: its size or checksum differs",
        database->path, (unsigned long long)reply->sequence);
}

/* Copies the row to the reply, unless it is damaged. The columns of a row are in memory: this does
 * not read the file. */
static enum percuss_status take_reply(struct database *database, sqlite3_stmt *row,
                                      struct stored_reply *reply, struct fault *fault)
{
    struct stored_reply stored;
    if (!reply_read_row(row, &stored))
        return reply_refuse_damaged(database, reply, fault);
    void *bytes = malloc(stored.size);
    if (!bytes)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: stored replies: out of memory",
                         database->path);
    *reply = stored;
    reply->bytes = memcpy(bytes, stored.bytes, stored.size);
    reply->damaged = false;
    return PERCUSS_OK;
}

/* Complains of damaged replies and marks. False: they cannot be read. */
static bool replies_audit(struct database *database, struct audit *audit)
{
    char problem[160];
    int found;
    /* replies: the store is usable without a damaged one */
    sqlite3_stmt *replies = database_statement(database, STATEMENT_REPLIES);
    for (; (found = sqlite3_step(replies)) == SQLITE_ROW; audit->replies++) {
        struct stored_reply reply;
        if (reply_read_row(replies, &reply))
            continue;
        snprintf(problem, sizeof problem,
                 "the stored reply to request %llu is damaged: its size or checksum differs",
                 (unsigned long long)sqlite3_column_int64(replies, 1));
        audit->complain(audit->context, problem);
        audit->damaged++;
    }
    bool good = found == SQLITE_DONE;
    sqlite3_reset(replies);
    /* marks: without them requests might be answered twice */
    sqlite3_stmt *marks = database_statement(database, STATEMENT_MARKS);
    for (; good && (found = sqlite3_step(marks)) == SQLITE_ROW; audit->marks++) {
        uint64_t mark;
        if (take_mark(marks, &mark))
            continue;
        audit->complain(audit->context, "the mark of a client is damaged: its checksum differs");
        audit->damaged++;
        audit->unusable = true;
    }
    good = good && found == SQLITE_DONE;
    sqlite3_reset(marks);
    return good;
}

static bool fill_marks(struct database *database)
{
    sqlite3_stmt *marks = database_statement(database, STATEMENT_MARKS);
    int found;
    bool good = true;
    while (good && (found = sqlite3_step(marks)) == SQLITE_ROW) {
        uint8_t client[CLIENT_SIZE];
        good = sqlite3_column_bytes(marks, 0) == CLIENT_SIZE;
        if (!good)
            continue;
        memcpy(client, sqlite3_column_blob(marks, 0), sizeof client);
        good = set_mark(database, client, (uint64_t)sqlite3_column_int64(marks, 1));
    }
    sqlite3_reset(marks);
    return good && found == SQLITE_DONE;
}

/* Gives a checksum to replies and marks of older files, which have none. */
static bool replies_fill(struct database *database)
{
    sqlite3_stmt *replies = database_statement(database, STATEMENT_REPLIES);
    int found;
    bool good = true;
    while (good && (found = sqlite3_step(replies)) == SQLITE_ROW) {
        struct stored_reply reply;
        if (sqlite3_column_type(replies, 4) != SQLITE_NULL)
            continue;
        /* a malformed row stays without a checksum: replies_audit and specimen_store_find report
         * it */
        reply_read_row(replies, &reply);
        if (!reply_is_shaped(replies, &reply))
            continue;
        struct digest sum = reply_checksum(&reply);
        sqlite3_stmt *seal = database_statement(database, STATEMENT_SEAL_REPLY);
        sqlite3_bind_int64(seal, 1, sqlite3_column_int64(replies, 5));
        sqlite3_bind_blob(seal, 2, &sum, sizeof sum, SQLITE_STATIC);
        good = database_run(seal);
    }
    sqlite3_reset(replies);
    return good && found == SQLITE_DONE && fill_marks(database);
}

/* ---- specimens ---- */

enum { SIGNATURE_SIZE = 768 };

/* The signature of a body, in the column `nature`: all that its dents depend on, with 17 digits:
 * shape, sizes, elastic and plastic constants of the material; neither its modes nor its name. */
static void describe_signature(const struct body *body, char signature[SIGNATURE_SIZE])
{
    const struct material *material = &body->material;
    snprintf(signature, SIGNATURE_SIZE,
             "%s radius %.17g length %.17g width %.17g height %.17g tip_radius %.17g size %.17g "
             "%.17g %.17g young %.17g poisson %.17g density %.17g yield %.17g tangent %.17g",
             body->kind->name, body->radius, body->length, body->width, body->height,
             body->tip_radius, body->size[0], body->size[1], body->size[2], material->young,
             material->poisson, material->density, material->yield, material->tangent);
    /* files of bodies without one stay as they are */
    size_t length = strlen(signature);
    if (yield_rate_is_stated(&body->yield_rate))
        snprintf(signature + length, SIGNATURE_SIZE - length,
                 " rate reference %.17g exponent %.17g coefficient %.17g",
                 body->yield_rate.reference, body->yield_rate.exponent,
                 body->yield_rate.coefficient);
}

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

/* A row of a specimen; the texts point into the row. */
struct specimen_row {
    int64_t id;
    struct specimen specimen;
    const char *signature;
};

static struct digest specimen_checksum(const struct specimen_row *row)
{
    struct hasher hasher = {0};
    hash_text(&hasher, row->specimen.name);
    hash_text(&hasher, row->specimen.body);
    hash_text(&hasher, row->signature);
    hash_number(&hasher, row->specimen.impacts);
    dents_hash(&hasher, row->specimen.state);
    return hash_digest(&hasher);
}

/* Takes the columns of the row, without dents; false: out of memory, or it is no specimen's row. */
static bool specimen_take_row(sqlite3_stmt *statement, struct specimen_row *row)
{
    *row = (struct specimen_row){
        .id = sqlite3_column_int64(statement, 0),
        .specimen = {.name = (const char *)sqlite3_column_text(statement, 1),
                     .body = (const char *)sqlite3_column_text(statement, 2),
                     .impacts = (uint64_t)sqlite3_column_int64(statement, 4)},
        .signature = (const char *)sqlite3_column_text(statement, 3),
    };
    return row->specimen.name && row->specimen.body && row->signature;
}

/* Takes the row with its dents, for free(); BAD_REQUEST: its checksum differs. */
static enum percuss_status take_specimen(struct specimen_store *store, sqlite3_stmt *statement,
                                         struct specimen_row *row, struct body_state **state,
                                         struct fault *fault)
{
    *state = NULL;
    if (!specimen_take_row(statement, row))
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", store->database.path);
    enum percuss_status status = dents_read(&store->database, row->id, state, fault);
    row->specimen.state = *state;
    if (status)
        return status;
    struct digest sum = specimen_checksum(row);
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

static bool specimen_seal(struct database *database, int64_t id, const struct digest *sum)
{
    sqlite3_stmt *statement = database_statement(database, STATEMENT_SEAL);
    sqlite3_bind_int64(statement, 1, id);
    sqlite3_bind_blob(statement, 2, sum, sizeof *sum, SQLITE_STATIC);
    return database_run(statement);
}

/* Gives checksums to all rows of an older file. */
static bool store_fill(struct database *database)
{
    sqlite3_stmt *list = database_statement(database, STATEMENT_LIST);
    int found = SQLITE_ERROR;
    bool good = true;
    while (good && (found = sqlite3_step(list)) == SQLITE_ROW) {
        struct specimen_row row;
        struct body_state *state = NULL;
        good = specimen_take_row(list, &row) && !dents_read(database, row.id, &state, NULL);
        row.specimen.state = state;
        struct digest sum = good ? specimen_checksum(&row) : (struct digest){0, 0};
        good = good && specimen_seal(database, row.id, &sum);
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
    /* the file, and the counts of its rows */
    enum percuss_status status = database_open(&created->database, path, store_fill, fault);
    /* SQLite's message does not name a missing folder */
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

/* Whether the row is of that body with its present shape, size and material. */
static enum percuss_status specimen_check_body(const struct specimen_row *row,
                                               const struct body *body, struct fault *fault)
{
    char signature[SIGNATURE_SIZE];
    const char *name = row->specimen.name, *id = row->specimen.body;
    /* the body's id */
    if (strcmp(id, body->id) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%s: is a specimen of %s, not of %s: must be another name, or be cleared "
                         "first",
                         name, id, body->id);
    /* its shape, size and material */
    describe_signature(body, signature);
    if (strcmp(row->signature, signature) == 0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%s: is a specimen of another %s, whose shape, size or material was not that "
                     "of the catalogue now: must be another name, or be cleared first",
                     name, id);
}

/* PERCUSS_INTERNAL for a damaged specimen: the request is good. */
static enum percuss_status load_row(struct specimen_store *store, sqlite3_stmt *statement,
                                    const struct body *body, struct body_state **state,
                                    struct fault *fault)
{
    struct specimen_row row;
    if (take_specimen(store, statement, &row, state, fault))
        return PERCUSS_INTERNAL;
    enum percuss_status status = specimen_check_body(&row, body, fault);
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
    /* a known specimen: check it, and take its dents */
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

/* *created counts the new names. */
static bool write_change(struct specimen_store *store, const struct specimen_change *change,
                         size_t *created)
{
    char signature[SIGNATURE_SIZE];
    describe_signature(change->body, signature);
    /* add one to its impacts; insert a new name */
    sqlite3_stmt *hit = database_statement(&store->database, STATEMENT_HIT);
    sqlite3_bind_text(hit, 1, change->name, -1, SQLITE_STATIC);
    sqlite3_bind_text(hit, 2, change->body->id, -1, SQLITE_STATIC);
    sqlite3_bind_text(hit, 3, signature, -1, SQLITE_STATIC);
    if (sqlite3_step(hit) != SQLITE_ROW)
        return false;
    struct specimen_row row;
    if (!specimen_take_row(hit, &row))
        return false;
    *created += row.specimen.impacts == 1;
    row.specimen.state = change->after;
    struct digest sum = specimen_checksum(&row);
    /* a RETURNING statement must run to its end */
    if (sqlite3_step(hit) != SQLITE_DONE)
        return false;
    sqlite3_reset(hit);
    /* replace its dents, then the checksum */
    return dents_write(&store->database, row.id, change->after) &&
           specimen_seal(&store->database, row.id, &sum);
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
    /* several replies where the limit was lowered */
    for (; good && kept > store->most_replies; kept--)
        good = replies_drop_oldest(database);
    good = good && database_run(database_statement(database, STATEMENT_COMMIT));
    if (good) {
        store->replies = kept;
        store->specimens += created;
        return PERCUSS_OK;
    }
    /* or roll all of it back */
    enum percuss_status status = database_fault(database, "the impact is not stored", fault);
    database_roll_back(database);
    return status;
}

enum percuss_status specimen_store_find(struct specimen_store *store, struct stored_reply *reply,
                                        struct fault *fault)
{
    struct database *database = &store->database;
    uint64_t mark;
    sqlite3_stmt *statement = database_statement(database, STATEMENT_REPLY);
    reply->bytes = NULL;
    reply->damaged = false;
    /* a kept reply */
    sqlite3_bind_blob(statement, 1, reply->client, sizeof reply->client, SQLITE_STATIC);
    sqlite3_bind_int64(statement, 2, (int64_t)reply->sequence);
    int found = sqlite3_step(statement);
    if (found == SQLITE_ROW) {
        enum percuss_status status = take_reply(database, statement, reply, fault);
        sqlite3_reset(statement);
        return status;
    }
    /* no reply: up to the client's mark it may have been dropped */
    if (found != SQLITE_DONE)
        return database_fault(database, "stored replies", fault);
    sqlite3_reset(statement);
    enum percuss_status status = read_mark(database, reply->client, &mark, fault);
    if (status || reply->sequence > mark)
        return status;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "sequence: %llu: replies up to %llu of this client are no longer kept: must "
                     "be above",
                     (unsigned long long)reply->sequence, (unsigned long long)mark);
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
        /* each with its dents, which the visitor borrows; a damaged one does not end the visit */
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
    if (!status && found != SQLITE_DONE)
        status = database_fault(&store->database, "specimens", fault);
    sqlite3_reset(statement);
    return status;
}

/* Complains of damaged specimens. False: they cannot be read. */
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
