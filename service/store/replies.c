/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/replies.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "store/database.h"

/* The mark of a client; 0: it has none. Sequences are unsigned, columns are not. */
static bool read_mark(struct database *database, const void *client, uint64_t *mark)
{
    sqlite3_stmt *statement = database_statement(database, STATEMENT_MARKED);
    sqlite3_bind_blob(statement, 1, client, 16, SQLITE_STATIC);
    int found = sqlite3_step(statement);
    *mark = found == SQLITE_ROW ? (uint64_t)sqlite3_column_int64(statement, 0) : 0;
    sqlite3_reset(statement);
    return found == SQLITE_ROW || found == SQLITE_DONE;
}

bool replies_drop_oldest(struct database *database)
{
    uint8_t client[16];
    uint64_t mark;
    sqlite3_stmt *oldest = database_statement(database, STATEMENT_OLDEST);
    /* the reply that was stored first */
    if (sqlite3_step(oldest) != SQLITE_ROW || sqlite3_column_bytes(oldest, 1) != 16)
        return false;
    int64_t id = sqlite3_column_int64(oldest, 0);
    memcpy(client, sqlite3_column_blob(oldest, 1), sizeof client);
    uint64_t sequence = (uint64_t)sqlite3_column_int64(oldest, 2);
    sqlite3_reset(oldest);
    sqlite3_stmt *drop = database_statement(database, STATEMENT_DROP);
    sqlite3_bind_int64(drop, 1, id);
    if (!database_run(drop) || !read_mark(database, client, &mark))
        return false;
    /* its client's mark: replies up to there are no longer kept */
    if (sequence <= mark)
        return true;
    sqlite3_stmt *set = database_statement(database, STATEMENT_MARK);
    sqlite3_bind_blob(set, 1, client, sizeof client, SQLITE_STATIC);
    sqlite3_bind_int64(set, 2, (int64_t)sequence);
    return database_run(set);
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
    return sqlite3_column_bytes(row, 0) == sizeof reply->content &&
           sqlite3_column_bytes(row, 1) > 0;
}

/* Whether the row, copied to the reply, is what was kept. */
static bool is_intact(sqlite3_stmt *row, const struct stored_reply *reply)
{
    if (sqlite3_column_type(row, 2) == SQLITE_NULL)
        return true;
    struct digest sum = checksum(reply);
    const void *kept = sqlite3_column_blob(row, 2);
    return sqlite3_column_bytes(row, 2) == sizeof sum && memcmp(kept, &sum, sizeof sum) == 0;
}

/* PERCUSS_INTERNAL; the reply holds nothing then. */
static enum percuss_status refuse_damaged(struct database *database, struct stored_reply *reply,
                                          struct fault *fault)
{
    free(reply->bytes);
    reply->bytes = NULL;
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
    if (!is_shaped(row, reply))
        return refuse_damaged(database, reply, fault);
    reply->size = (size_t)sqlite3_column_bytes(row, 1);
    reply->bytes = malloc(reply->size);
    if (!reply->bytes)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: stored replies: out of memory",
                         database->path);
    memcpy(reply->content, sqlite3_column_blob(row, 0), sizeof reply->content);
    memcpy(reply->bytes, sqlite3_column_blob(row, 1), reply->size);
    return is_intact(row, reply) ? PERCUSS_OK : refuse_damaged(database, reply, fault);
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
    if (found != SQLITE_DONE || !read_mark(database, reply->client, &mark))
        return database_fault(database, "stored replies", fault);
    sqlite3_reset(statement);
    if (reply->sequence > mark)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "sequence: %llu: replies up to %llu of this client are no longer kept: must "
                     "be above",
                     (unsigned long long)reply->sequence, (unsigned long long)mark);
}
