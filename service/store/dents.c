/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/dents.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "store/database.h"

enum { COLUMNS = 8 };

/* So that no column is forgotten when a dent learns something new. */
_Static_assert(sizeof(struct dent) == COLUMNS * sizeof(double), "dents have other columns");

enum percuss_status dents_read(struct database *database, int64_t id, struct body_state **state,
                               struct fault *fault)
{
    /* how many there are */
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
    /* it is at rest: no mode is left out */
    for (size_t f = 0; f < sizeof read->known / sizeof *read->known; f++)
        read->known[f] = SIZE_MAX;
    /* their numbers, in the order of the struct */
    sqlite3_stmt *statement = database_statement(database, STATEMENT_DENTS);
    sqlite3_bind_int64(statement, 1, id);
    double *numbers = (double *)body_state_dents(read);
    size_t rows = 0;
    for (; rows < sizes.dents && sqlite3_step(statement) == SQLITE_ROW; rows++)
        for (int column = 0; column < COLUMNS; column++)
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
    for (int column = 0; column < COLUMNS; column++)
        sqlite3_bind_double(statement, 3 + column, numbers[column]);
    return database_run(statement);
}

bool dents_write(struct database *database, int64_t id, const struct body_state *state)
{
    sqlite3_stmt *smooth = database_statement(database, STATEMENT_SMOOTH);
    sqlite3_bind_int64(smooth, 1, id);
    bool good = database_run(smooth);
    size_t count = state ? state->dents : 0;
    for (size_t i = 0; good && i < count; i++)
        good = write_dent(database, id, i, &body_state_dents(state)[i]);
    return good;
}

void dents_hash(struct hasher *hasher, const struct body_state *state)
{
    size_t count = state ? COLUMNS * state->dents : 0;
    const double *numbers = state ? (const double *)body_state_dents(state) : NULL;
    hash_number(hasher, count);
    for (size_t i = 0; i < count; i++) {
        double number = numbers[i] + 0.0;
        uint64_t bits;
        memcpy(&bits, &number, sizeof bits);
        hash_number(hasher, bits);
    }
}
