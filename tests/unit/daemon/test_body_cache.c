/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* daemon/reducer: which files of the folder stay, and which go. */
#include "daemon/reducer.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "check.h"

static char folder[] = "/tmp/test_body_cache_XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return chdir("/") || rmdir(folder);
}

/* 64 times the letter, and the suffix; used so many days ago */
static const char *file(char letter, const char *suffix, double days)
{
    static char name[100];
    memset(name, letter, 64);
    strcpy(name + 64, suffix);
    struct timespec times[2] = {{.tv_sec = time(NULL) - (time_t)(86400.0 * days)}};
    times[1] = times[0];
    int stream = open(name, O_CREAT | O_WRONLY, 0600);
    assert_true(stream >= 0 && futimens(stream, times) == 0);
    close(stream);
    return name;
}

static bool there(const char *name)
{
    return access(name, F_OK) == 0;
}

/* The letter's order; `made` so that it is used. */
static struct body_order order(char letter, bool made)
{
    struct body_order order = {.made = made};
    memset(order.name, letter, 64);
    return order;
}

static void tidy(void)
{
    struct body_order orders[] = {order('a', true), order('b', false)};
    reducer_tidy(folder, &(struct body_set){.orders = orders, .order_count = 2}, 30.0);
}

static void what_is_used_stays_and_looks_it(void **state)
{
    (void)state;
    struct stat used;
    const char *name = file('a', ".h5", 100.0);
    tidy();
    assert_int_equal(stat(name, &used), 0);
    /* by the clock of the file system, which is rounded to its ticks */
    assert_true(labs((long)(time(NULL) - used.st_mtime)) < 60);
    remove(name);
    /* named, but made by nobody yet: its failure */
    name = file('b', ".failed", 100.0);
    tidy();
    assert_true(there(name));
    remove(name);
}

static void what_nobody_names_goes_with_age(void **state)
{
    (void)state;
    static const char *const suffixes[] = {".h5", ".failed", ".killed"};
    for (int i = 0; i < 3; i++) {
        const char *name = file('c', suffixes[i], 29.0);
        tidy();
        assert_true(there(name));
        name = file('c', suffixes[i], 31.0);
        tidy();
        assert_false(there(name));
    }
}

static void nothing_of_others_goes(void **state)
{
    (void)state;
    static const char *const suffixes[] = {".hdf5", ".h5.bak", ".yaml", "0.h5", ".12.txt", ".x.h5"};
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++) {
        const char *name = file('c', suffixes[i], 1000.0);
        tidy();
        assert_true(there(name));
        remove(name);
    }
    /* letters that no hash has */
    const char *name = file('g', ".h5", 1000.0);
    tidy();
    assert_true(there(name));
    remove(name);
    /* no file at all */
    name = file('c', ".h5", 1000.0);
    remove(name);
    assert_int_equal(mkdir(name, 0700), 0);
    utimensat(AT_FDCWD, name, (struct timespec[2]){{.tv_sec = 1}, {.tv_sec = 1}}, 0);
    tidy();
    assert_true(there(name));
    rmdir(name);
}

static void what_a_process_left_behind_goes(void **state)
{
    (void)state;
    char suffix[40];
    pid_t gone = fork();
    if (gone == 0)
        _exit(0);
    waitpid(gone, NULL, 0);
    /* of the one that is gone, named or not: with age */
    snprintf(suffix, sizeof suffix, ".%d.messages", (int)gone);
    const char *name = file('a', suffix, 1.0);
    tidy();
    assert_true(there(name));
    name = file('a', suffix, 3.0);
    tidy();
    assert_false(there(name));
    /* of one that is there */
    snprintf(suffix, sizeof suffix, ".%d.h5", (int)getpid());
    name = file('c', suffix, 100.0);
    tidy();
    assert_true(there(name));
    remove(name);
}

static void a_folder_that_is_not_there(void **state)
{
    (void)state;
    reducer_tidy("/none/such", &(struct body_set){.order_count = 0}, 30.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_used_stays_and_looks_it),
        cmocka_unit_test(what_nobody_names_goes_with_age),
        cmocka_unit_test(nothing_of_others_goes),
        cmocka_unit_test(what_a_process_left_behind_goes),
        cmocka_unit_test(a_folder_that_is_not_there),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
