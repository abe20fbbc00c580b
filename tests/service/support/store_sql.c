/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Changes the store of a stopped daemon. usage: store_sql FILE STATEMENTS */
#include <sqlite3.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    sqlite3 *connection;
    if (argc != 3) {
        fprintf(stderr, "usage: store_sql FILE STATEMENTS\n");
        return 2;
    }
    if (sqlite3_open_v2(argv[1], &connection, SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK ||
        sqlite3_exec(connection, argv[2], NULL, NULL, NULL) != SQLITE_OK ||
        sqlite3_changes(connection) == 0) {
        fprintf(stderr, "store_sql: %s\n", sqlite3_errmsg(connection));
        return 1;
    }
    sqlite3_close(connection);
    return 0;
}
