/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* daemon/standby: one process at a time has the place, under one id, until it ends or loses it; and
 * what a file must be for that. */
#include "daemon/standby.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"

static char folder[] = "/tmp/test_standby_XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? chdir(folder) : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink("lock");
    return chdir("/") || rmdir(folder);
}

/* What standby_take says, in a process of its own that ends with it. */
static int take_elsewhere(uint8_t server[16])
{
    int ends[2], status;
    struct fault fault;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        status = (int)standby_take("lock", server, &fault);
        _exit(write(ends[1], server, 16) == 16 ? status : 99);
    }
    assert_int_equal(read(ends[0], server, 16), 16);
    assert_int_equal(waitpid(child, &status, 0), child);
    close(ends[0]);
    close(ends[1]);
    return WEXITSTATUS(status);
}

/* A process that takes the place and keeps it, with a child of its own that outlives it. */
static pid_t hold(uint8_t server[16], pid_t *orphan)
{
    int ends[2];
    struct fault fault;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        if (standby_take("lock", server, &fault))
            _exit(1);
        pid_t own = fork();
        while (own == 0)
            pause();
        if (write(ends[1], server, 16) != 16 || write(ends[1], &own, sizeof own) != sizeof own)
            _exit(1);
        for (;;)
            pause();
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], server, 16), 16);
    assert_int_equal(read(ends[0], orphan, sizeof *orphan), sizeof *orphan);
    close(ends[0]);
    return child;
}

static void test_one_at_a_time(void **state)
{
    (void)state;
    uint8_t first[16], second[16] = {0};
    pid_t orphan, holder = hold(first, &orphan);
    assert_int_equal(take_elsewhere(second), PERCUSS_BUSY);
    /* whoever waits has the place as soon as the holder has been killed, under the same id */
    kill(holder, SIGKILL);
    assert_int_equal(waitpid(holder, NULL, 0), holder);
    assert_int_equal(take_elsewhere(second), PERCUSS_OK);
    assert_memory_equal(first, second, sizeof first);
    kill(orphan, SIGKILL);
    /* another file is another task */
    assert_int_equal(unlink("lock"), 0);
    assert_int_equal(take_elsewhere(second), PERCUSS_OK);
    assert_memory_not_equal(first, second, sizeof first);
}

/* This process's until another one has the lock, or the file has another name. */
static void test_lost(void **state)
{
    (void)state;
    unlink("lock");
    uint8_t server[16], other[16];
    struct fault fault;
    pid_t orphan;
    assert_false(standby_is_held("lock"));
    assert_int_equal(standby_take("lock", server, &fault), PERCUSS_OK);
    assert_true(standby_is_held("lock"));
    assert_int_equal(take_elsewhere(other), PERCUSS_BUSY);
    /* the system gives away all locks of a process on a file when it closes any of its openings */
    int again = open("lock", O_RDONLY);
    assert_true(again >= 0);
    close(again);
    pid_t holder = hold(other, &orphan);
    assert_memory_equal(server, other, sizeof server);
    assert_false(standby_is_held("lock"));
    kill(orphan, SIGKILL);
    kill(holder, SIGKILL);
    assert_int_equal(waitpid(holder, NULL, 0), holder);
    assert_true(standby_is_held("lock"));
    /* deleted, and replaced */
    assert_int_equal(unlink("lock"), 0);
    assert_false(standby_is_held("lock"));
    assert_int_equal(take_elsewhere(other), PERCUSS_OK);
    assert_false(standby_is_held("lock"));
}

static void write_lock(const char *text)
{
    FILE *file = fopen("lock", "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void test_files(void **state)
{
    (void)state;
    static const char *const foreign[] = {
        "x", "0123456789abcdef0123456789abcdeF\n", "0123456789abcdef0123456789abcdef",
        "0123456789abcdef0123456789abcdef\n\n", "SQLite format 3, which is somebody's store\n"};
    uint8_t server[16];
    struct fault fault;
    /* another program's file is left alone */
    for (size_t i = 0; i < COUNT(foreign); i++) {
        write_lock(foreign[i]);
        assert_int_equal(standby_take("lock", server, &fault), PERCUSS_BAD_REQUEST);
        assert_string_equal(fault.text,
                            "lock: must be empty or hold a server id of 32 hexadecimal digits");
    }
    write_lock("0123456789abcdef00ff000000000001\n");
    assert_int_equal(take_elsewhere(server), PERCUSS_OK);
    static const uint8_t said[16] = {0x01, 0x23, 0x45, 0x67, 0x89, 0xab, 0xcd, 0xef,
                                     0x00, 0xff, 0,    0,    0,    0,    0,    1};
    assert_memory_equal(server, said, sizeof said);
    /* no file can be there */
    assert_int_equal(standby_take(".", server, &fault), PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text, ".: Is a directory");
    assert_int_equal(standby_take("none/lock", server, &fault), PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text, "none/lock: No such file or directory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_at_a_time),
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_lost),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
