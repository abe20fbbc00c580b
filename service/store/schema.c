/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/schema.h"

#include "store/database.h"

/* The columns of a dent are those of struct dent, in its order. The mark of a client is the highest
 * number among its replies that are no longer kept. A checksum is over all that a row says; that of
 * a specimen covers its dents. */
const char schema_new[] =
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

/* Checksums that these columns lack are put in before the upgrade is over. */
const char *const schema_upgrades[] = {
    "ALTER TABLE replies ADD COLUMN checksum BLOB",
    "ALTER TABLE specimens ADD COLUMN checksum BLOB; ALTER TABLE marks ADD COLUMN checksum BLOB"};

const char *const schema_statements[STATEMENT_COUNT] = {
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
