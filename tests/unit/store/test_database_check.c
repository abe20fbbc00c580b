/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests store/database_check.c: it refuses what opening the store refuses, in the same words where
 * there are the same, and leaves no trace. */
#include <dirent.h>
#include <signal.h>
#include <sqlite3.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "store/database.h"
#include "store/database_check.h"
#include "store/specimens.h"

static char folder[64], path[128];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/percuss-check-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/store.db", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    rmdir(path);
    return rmdir(folder);
}

static size_t files(void)
{
    size_t count = 0;
    DIR *stream = opendir(folder);
    while (readdir(stream))
        count++;
    closedir(stream);
    return count - 2;
}

/* Whether it may be opened, with a text of the refusal; both must say so. */
static void agrees(enum percuss_status expected, const char *text)
{
    struct fault checked, opened;
    struct specimen_store *store;
    size_t before = files();
    assert_int_equal(database_check(path, SCHEMA_VERSION, &checked), expected);
    assert_int_equal(files(), before);
    assert_int_equal(specimen_store_open(path, 1, &store, &opened), expected);
    specimen_store_close(store);
    if (expected) {
        assert_non_null(strstr(checked.text, text));
        assert_non_null(strstr(opened.text, text));
    }
}

static void run_sql(const char *text)
{
    sqlite3 *connection;
    assert_int_equal(sqlite3_open(path, &connection), SQLITE_OK);
    assert_int_equal(sqlite3_exec(connection, text, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(connection);
}

static void write_text(const char *text)
{
    FILE *file = fopen(path, "w");
    fputs(text, file);
    fclose(file);
}

static void new_and_own_stores_are_good(void **state)
{
    (void)state;
    agrees(PERCUSS_OK, "");
    agrees(PERCUSS_OK, "");
    unlink(path);
    /* an empty file becomes a store */
    write_text("");
    agrees(PERCUSS_OK, "");
}

static void other_files_are_refused(void **state)
{
    (void)state;
    write_text(
        "no database, but longer than the header of one: ......................................"
        "........................................................");
    agrees(PERCUSS_BAD_REQUEST, "file is not a database");
    unlink(path);
    run_sql("CREATE TABLE other (x)");
    agrees(PERCUSS_BAD_REQUEST, "is a database of another program");
    unlink(path);
    agrees(PERCUSS_OK, "");
    run_sql("PRAGMA user_version = 99");
    agrees(PERCUSS_BAD_REQUEST, "is of version 99: must be of version 1 to");
    unlink(path);
    mkdir(path, 0755);
    struct fault fault;
    assert_int_equal(database_check(path, 1, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "is no file"));
}

static void a_missing_folder_is_told(void **state)
{
    (void)state;
    struct fault fault;
    char expected[400];
    snprintf(path, sizeof path, "%s/not/there/this.db", folder);
    agrees(PERCUSS_BAD_REQUEST, "cannot be made: No such file or directory");
    assert_int_equal(database_check(path, 1, &fault), PERCUSS_BAD_REQUEST);
    snprintf(expected, sizeof expected,
             "%s: cannot be made: No such file or directory: its folder is missing: mkdir -p "
             "%s/not/there makes it",
             path, folder);
    assert_string_equal(fault.text, expected);
    /* where this user may not */
    assert_int_equal(database_check("/proc/not/there/this.db", 1, &fault), PERCUSS_BAD_REQUEST);
    snprintf(expected, sizeof expected, "missing: %s /proc/not/there makes it",
             geteuid() ? "sudo install -d -o \"$(id -un)\"" : "mkdir -p");
    assert_non_null(strstr(fault.text, expected));
    /* a name alone is in the working folder, which tests may write to */
    assert_int_equal(database_folder_check("name", &fault), PERCUSS_OK);
}

/* Locks are those of other processes. */
static void a_store_in_use_is_told(void **state)
{
    (void)state;
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        struct specimen_store *store;
        struct fault fault;
        if (specimen_store_open(path, 1, &store, &fault) == PERCUSS_OK &&
            write(ends[1], "", 1) == 1)
            pause();
        _exit(1);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &byte, 1), 1);
    struct fault fault;
    char expected[64];
    assert_int_equal(database_check(path, SCHEMA_VERSION, &fault), PERCUSS_BAD_REQUEST);
    snprintf(expected, sizeof expected, "is in use by another process (%ld)", (long)child);
    assert_non_null(strstr(fault.text, expected));
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    close(ends[0]);
    /* a lock goes with its process */
    agrees(PERCUSS_OK, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(new_and_own_stores_are_good, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(other_files_are_refused, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(a_missing_folder_is_told, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(a_store_in_use_is_told, make_folder, remove_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
