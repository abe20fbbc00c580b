/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests base/atomic_file.c: the file appears whole or the former one is left, and no link at either
 * name leads to another file. */
#include "base/atomic_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"

static char folder[64], path[96], aside[128], victim[96];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/percuss-atomic-XXXXXX");
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/file", folder);
    snprintf(aside, sizeof aside, "%s/file.part", folder);
    snprintf(victim, sizeof victim, "%s/victim", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    unlink(aside);
    unlink(victim);
    return rmdir(folder);
}

static void put(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void holds(const char *name, const char *text)
{
    char found[64] = "";
    FILE *file = fopen(name, "r");
    assert_non_null(file);
    found[fread(found, 1, sizeof found - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(found, text);
}

static bool is_regular(const char *name)
{
    struct stat about;
    return lstat(name, &about) == 0 && S_ISREG(about.st_mode);
}

static enum percuss_status store(const char *text, bool durable, struct fault *fault)
{
    struct atomic_file file;
    int descriptor = atomic_file_create(&file, path, 0640, fault);
    if (descriptor < 0)
        return PERCUSS_BAD_REQUEST;
    assert_int_equal(write(descriptor, text, strlen(text)), strlen(text));
    close(descriptor);
    return atomic_file_finish(&file, durable, fault);
}

static void gets_its_name_when_it_is_whole(void **state)
{
    (void)state;
    struct atomic_file file;
    struct stat about;
    for (int durable = 0; durable < 2; durable++) {
        assert_int_equal(store("first", durable, NULL), PERCUSS_OK);
        holds(path, "first");
        assert_int_equal(store("second", durable, NULL), PERCUSS_OK);
        holds(path, "second");
        assert_int_not_equal(access(aside, F_OK), 0);
    }
    stat(path, &about);
    assert_int_equal(about.st_mode & 0777, 0640);
    /* interrupted: the former file is left, and what lies beside it is no obstacle */
    int descriptor = atomic_file_create(&file, path, 0640, NULL);
    assert_int_equal(write(descriptor, "half", 4), 4);
    close(descriptor);
    holds(path, "second");
    holds(aside, "half");
    assert_int_equal(store("third", true, NULL), PERCUSS_OK);
    holds(path, "third");
    /* given up */
    close(atomic_file_create(&file, path, 0640, NULL));
    atomic_file_abandon(&file);
    assert_int_not_equal(access(aside, F_OK), 0);
    holds(path, "third");
}

static void follows_no_link(void **state)
{
    (void)state;
    struct atomic_file file;
    put(victim, "precious");
    for (int durable = 0; durable < 2; durable++) {
        assert_int_equal(symlink(victim, aside), 0);
        assert_int_equal(store("new", durable, NULL), PERCUSS_OK);
        holds(victim, "precious");
        holds(path, "new");
        assert_true(is_regular(path));
        /* a hard link, and a link at the name itself */
        assert_int_equal(link(victim, aside), 0);
        assert_int_equal(store("newer", durable, NULL), PERCUSS_OK);
        holds(victim, "precious");
        unlink(path);
        assert_int_equal(symlink(victim, path), 0);
        assert_int_equal(store("newest", durable, NULL), PERCUSS_OK);
        holds(victim, "precious");
        holds(path, "newest");
        assert_true(is_regular(path));
    }
    /* a link that took the place of what was written: it is not synchronised, nothing is named */
    close(atomic_file_create(&file, path, 0640, NULL));
    unlink(aside);
    assert_int_equal(symlink(victim, aside), 0);
    assert_int_equal(atomic_file_finish(&file, true, NULL), PERCUSS_BAD_REQUEST);
    holds(path, "newest");
    holds(victim, "precious");
}

static void names_the_obstacle(void **state)
{
    (void)state;
    struct fault fault = {""};
    char expected[200];
    /* a folder at the name of the part, or at the name */
    assert_int_equal(mkdir(aside, 0700), 0);
    assert_int_equal(store("text", true, &fault), PERCUSS_BAD_REQUEST);
    snprintf(expected, sizeof expected, "%s: cannot be written: Is a directory", aside);
    assert_string_equal(fault.text, expected);
    assert_int_equal(errno, EISDIR);
    rmdir(aside);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_int_equal(store("text", true, &fault), PERCUSS_BAD_REQUEST);
    snprintf(expected, sizeof expected, "%s: cannot be written: Is a directory", path);
    assert_string_equal(fault.text, expected);
    rmdir(path);
    /* no device is replaced */
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_int_equal(store("text", false, &fault), PERCUSS_BAD_REQUEST);
    unlink(path);
    /* a folder that is missing, or too long a name */
    struct atomic_file file;
    assert_int_equal(atomic_file_create(&file, "/nowhere/file", 0640, &fault), -1);
    assert_string_equal(fault.text, "/nowhere/: cannot be written: No such file or directory");
    assert_int_equal(errno, ENOENT);
    char name[ATOMIC_FILE_SIZE];
    memset(name, 'a', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assert_int_equal(atomic_file_create(&file, name, 0640, &fault), -1);
    assert_non_null(strstr(fault.text, ": cannot be written: File name too long"));
}

/* As another user than root, to whom every folder is open. */
static void names_a_folder_that_is_closed(void **state)
{
    (void)state;
    struct fault fault = {""};
    char expected[200];
    bool root = getuid() == 0;
    if (root)
        assert_int_equal(setreuid(65534, 0), 0);
    chmod(folder, 0555);
    assert_int_equal(store("text", true, &fault), PERCUSS_BAD_REQUEST);
    snprintf(expected, sizeof expected, "%s/: cannot be written: Permission denied", folder);
    assert_string_equal(fault.text, expected);
    chmod(folder, 0700);
    if (root)
        assert_int_equal(setreuid(0, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(gets_its_name_when_it_is_whole, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(follows_no_link, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(names_the_obstacle, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(names_a_folder_that_is_closed, make_folder, remove_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
