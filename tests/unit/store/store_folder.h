/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A folder of its own for each test, and the path of a database there. */
#ifndef PERCUSS_TEST_STORE_FOLDER_H
#define PERCUSS_TEST_STORE_FOLDER_H

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

static char folder[64], path[128];

static inline int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/percuss-store-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/store.db", folder);
    return 0;
}

static inline int remove_folder(void **state)
{
    (void)state;
    char name[160];
    const char *const ends[] = {"", "-wal", "-shm", "-journal"};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        snprintf(name, sizeof name, "%s%s", path, ends[i]);
        unlink(name);
    }
    return rmdir(folder);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

#endif
