/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Changes the store of a stopped daemon, or with SECONDS says "held" and keeps what locks the
 * statements have taken for so long. usage: store_sql FILE STATEMENTS [SECONDS] */
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    sqlite3 *connection;
    if (argc != 3 && argc != 4) {
        fprintf(stderr, "usage: store_sql FILE STATEMENTS [SECONDS]\n");
        return 2;
    }
    unsigned seconds = argc == 4 ? (unsigned)strtoul(argv[3], NULL, 10) : 0;
    if (sqlite3_open_v2(argv[1], &connection, SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK ||
        sqlite3_exec(connection, argv[2], NULL, NULL, NULL) != SQLITE_OK ||
        (seconds == 0 && sqlite3_changes(connection) == 0)) {
        fprintf(stderr, "store_sql: %s\n", sqlite3_errmsg(connection));
        return 1;
    }
    if (seconds > 0) {
        puts("held");
        fflush(stdout);
        sleep(seconds);
    }
    sqlite3_close(connection);
    return 0;
}
