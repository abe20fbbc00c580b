/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/replies.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "store/database.h"

enum { CLIENT_SIZE = 16 };

static struct digest mark_checksum(const void *client, uint64_t mark)
{
    struct hasher hasher = {0};
    hash_bytes(&hasher, client, CLIENT_SIZE);
    hash_number(&hasher, mark);
    return hash_digest(&hasher);
}

/* The mark in a row, if it is what was set. Sequences are unsigned, columns are not. */
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

bool replies_drop_oldest(struct database *database)
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
    /* its client's mark: replies up to there are no longer kept */
    return sequence <= mark || set_mark(database, client, sequence);
}

/* Over all that a row says. */
static struct digest checksum(const struct stored_reply *reply)
{
    struct hasher hasher = {0};
    hash_bytes(&hasher, reply->client, sizeof reply->client);
    hash_number(&hasher, reply->sequence);
    hash_bytes(&hasher, reply->content, sizeof reply->content);
    hash_bytes(&hasher, reply->bytes, reply->size);
    return hash_digest(&hasher);
}

bool replies_keep(struct database *database, const struct stored_reply *reply)
{
    sqlite3_stmt *keep = database_statement(database, STATEMENT_KEEP);
    sqlite3_bind_blob(keep, 1, reply->client, sizeof reply->client, SQLITE_STATIC);
    sqlite3_bind_int64(keep, 2, (int64_t)reply->sequence);
    sqlite3_bind_blob(keep, 3, reply->content, sizeof reply->content, SQLITE_STATIC);
    sqlite3_bind_blob64(keep, 4, reply->bytes, reply->size, SQLITE_STATIC);
    struct digest sum = checksum(reply);
    sqlite3_bind_blob(keep, 5, &sum, sizeof sum, SQLITE_STATIC);
    return database_run(keep);
}

/* Whether the row has the sizes of a reply. */
static bool is_shaped(sqlite3_stmt *row, const struct stored_reply *reply)
{
    return sqlite3_column_bytes(row, 0) == CLIENT_SIZE &&
           sqlite3_column_bytes(row, 2) == sizeof reply->content &&
           sqlite3_column_bytes(row, 3) > 0;
}

/* The row as a reply, whose bytes stay the row's; false: it is not what was kept. */
static bool read_row(sqlite3_stmt *row, struct stored_reply *reply)
{
    if (!is_shaped(row, reply))
        return false;
    memcpy(reply->client, sqlite3_column_blob(row, 0), sizeof reply->client);
    reply->sequence = (uint64_t)sqlite3_column_int64(row, 1);
    memcpy(reply->content, sqlite3_column_blob(row, 2), sizeof reply->content);
    reply->size = (size_t)sqlite3_column_bytes(row, 3);
    reply->bytes = (void *)sqlite3_column_blob(row, 3);
    struct digest sum = checksum(reply);
    return database_matches(row, 4, &sum);
}

static enum percuss_status refuse_damaged(struct database *database, struct stored_reply *reply,
                                          struct fault *fault)
{
    reply->damaged = true;
    return fault_set(
        fault, PERCUSS_INTERNAL,
        "%s: the stored reply to request %llu is damaged: its size or checksum differs",
        database->path, (unsigned long long)reply->sequence);
}

/* Copies the row to the reply, if it is what was kept. What a row says is in memory: taking it does
 * not read the file. */
static enum percuss_status take_reply(struct database *database, sqlite3_stmt *row,
                                      struct stored_reply *reply, struct fault *fault)
{
    struct stored_reply kept;
    if (!read_row(row, &kept))
        return refuse_damaged(database, reply, fault);
    void *bytes = malloc(kept.size);
    if (!bytes)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: stored replies: out of memory",
                         database->path);
    *reply = kept;
    reply->bytes = memcpy(bytes, kept.bytes, kept.size);
    reply->damaged = false;
    return PERCUSS_OK;
}

enum percuss_status replies_find(struct database *database, struct stored_reply *reply,
                                 struct fault *fault)
{
    uint64_t mark;
    sqlite3_stmt *statement = database_statement(database, STATEMENT_REPLY);
    reply->bytes = NULL;
    reply->damaged = false;
    /* the reply, where it is kept */
    sqlite3_bind_blob(statement, 1, reply->client, sizeof reply->client, SQLITE_STATIC);
    sqlite3_bind_int64(statement, 2, (int64_t)reply->sequence);
    int found = sqlite3_step(statement);
    if (found == SQLITE_ROW) {
        enum percuss_status status = take_reply(database, statement, reply, fault);
        sqlite3_reset(statement);
        return status;
    }
    /* below the client's mark it was once */
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

bool replies_audit(struct database *database, struct audit *audit)
{
    char problem[160];
    int found;
    /* replies: each can be done without */
    sqlite3_stmt *replies = database_statement(database, STATEMENT_REPLIES);
    for (; (found = sqlite3_step(replies)) == SQLITE_ROW; audit->replies++) {
        struct stored_reply reply;
        if (read_row(replies, &reply))
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

bool replies_fill(struct database *database)
{
    sqlite3_stmt *replies = database_statement(database, STATEMENT_REPLIES);
    int found;
    bool good = true;
    while (good && (found = sqlite3_step(replies)) == SQLITE_ROW) {
        struct stored_reply reply;
        if (sqlite3_column_type(replies, 4) != SQLITE_NULL)
            continue;
        /* what is no reply stays without, and is found to be damaged when it is asked for */
        read_row(replies, &reply);
        if (!is_shaped(replies, &reply))
            continue;
        struct digest sum = checksum(&reply);
        sqlite3_stmt *seal = database_statement(database, STATEMENT_SEAL_REPLY);
        sqlite3_bind_int64(seal, 1, sqlite3_column_int64(replies, 5));
        sqlite3_bind_blob(seal, 2, &sum, sizeof sum, SQLITE_STATIC);
        good = database_run(seal);
    }
    sqlite3_reset(replies);
    return good && found == SQLITE_DONE && fill_marks(database);
}
