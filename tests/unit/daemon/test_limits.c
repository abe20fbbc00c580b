/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/limits.c: control groups of both versions, what the caches may take, and refusals
 * with the number that is needed. */
#include "daemon/limits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"

static const unsigned long long MIB = 1048576;
static char root[64], member[96];

static void put(const char *name, const char *text)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", root, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void make(const char *name)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", root, name);
    assert_int_equal(mkdir(path, 0700), 0);
}

static int make_root(void **state)
{
    (void)state;
    strcpy(root, "/tmp/percuss-limits-XXXXXX");
    assert_non_null(mkdtemp(root));
    snprintf(member, sizeof member, "%s/member", root);
    return 0;
}

static int remove_root(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", root);
    return system(command);
}

static void groups_of_version_2(void **state)
{
    (void)state;
    make("a");
    make("a/b");
    put("member", "0::/a/b\n");
    /* none says anything, as on a machine without them */
    assert_int_equal(limits_cgroup(root, member), 0);
    assert_int_equal(limits_cgroup(root, "/nowhere"), 0);
    put("a/b/memory.max", "max\n");
    assert_int_equal(limits_cgroup(root, member), 0);
    /* that of a group above holds too, and the lowest */
    put("a/memory.max", "1073741824\n");
    assert_int_equal(limits_cgroup(root, member), 1073741824);
    put("a/b/memory.max", "536870912\n");
    assert_int_equal(limits_cgroup(root, member), 536870912);
    put("a/memory.max", "268435456\n");
    assert_int_equal(limits_cgroup(root, member), 268435456);
    /* in a container its own group is the root */
    put("memory.max", "134217728\n");
    put("member", "0::/\n");
    assert_int_equal(limits_cgroup(root, member), 134217728);
}

static void groups_of_version_1(void **state)
{
    (void)state;
    make("memory");
    make("memory/a");
    put("member", "5:devices:/\n4:memory:/a\n0::/\n");
    put("memory/memory.limit_in_bytes", "9223372036854771712\n");
    assert_int_equal(limits_cgroup(root, member), 0);
    put("memory/a/memory.limit_in_bytes", "268435456\n");
    assert_int_equal(limits_cgroup(root, member), 268435456);
    /* a path that is not seen from here: the group above it */
    put("member", "4:memory:/of/the/host\n");
    put("memory/memory.limit_in_bytes", "536870912\n");
    assert_int_equal(limits_cgroup(root, member), 536870912);
}

static void caches_keep_to_what_there_is(void **state)
{
    (void)state;
    struct settings settings = settings_default();
    settings.workers = 2;
    settings.token_megabytes = 256;
    settings.reply_megabytes = 100;
    /* no limit, or one that is high enough */
    assert_false(limits_fit_caches(&settings, 0, 0));
    settings.workers = 2;
    assert_false(limits_fit_caches(&settings, 4096 * MIB, 0));
    assert_int_equal(settings.token_megabytes, 256);
    assert_int_equal(settings.body_megabytes, 32 * limits_solving_threads(&settings));
    /* a quarter each, or an eighth of what is prepared, and never none */
    assert_true(limits_fit_caches(&settings, 512 * MIB, 0));
    assert_int_equal(settings.token_megabytes, 128);
    assert_int_equal(settings.reply_megabytes, 100);
    assert_int_equal(settings.box_megabytes, 64);
    assert_int_equal(settings.body_megabytes, 64);
    assert_true(limits_fit_caches(&settings, 2 * MIB, 0));
    assert_int_equal(settings.token_megabytes, 1);
    assert_int_equal(settings.reply_megabytes, 1);
    /* of the address space what is left */
    settings.token_megabytes = settings.reply_megabytes = settings.box_megabytes = 256;
    assert_false(limits_fit_caches(&settings, 0, 16384 * MIB));
    assert_true(limits_fit_caches(&settings, 0, 400 * MIB));
    assert_int_equal(settings.token_megabytes, 8);
    assert_int_equal(settings.reply_megabytes, 8);
    assert_int_equal(settings.box_megabytes, 8);
    assert_int_equal(settings.body_megabytes, 8);
    /* of a stated sum a quarter each, of which a part may be less */
    settings = settings_default();
    settings.limit_megabytes = 400;
    settings.reply_megabytes = 30;
    assert_true(limits_fit_caches(&settings, 0, 0));
    assert_int_equal(settings.token_megabytes, 100);
    assert_int_equal(settings.reply_megabytes, 30);
    assert_int_equal(settings.box_megabytes, 100);
    assert_int_equal(settings.body_megabytes, 100);
}

static void threads_need_address_space(void **state)
{
    (void)state;
    struct settings settings = settings_default();
    settings.workers = 2;
    unsigned long long two = limits_address_space(&settings, 8 * MIB);
    assert_true(two > 400 * 1024 && two < 600 * 1024);
    settings.workers = 32;
    assert_int_equal(limits_address_space(&settings, 8 * MIB) - two, 30 * 5 * 8 * 1024);
    assert_true(limits_address_space(&settings, MIB) < 600 * 1024);
}

/* The fault's text under a limit, in a process of its own; "" where there is none. */
static void text_under(int kind, rlim_t soft, rlim_t hard, char text[640])
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        struct fault fault = {""};
        struct settings settings = settings_default();
        struct rlimit limit = {soft, hard};
        settings.workers = 2;
        bool set = setrlimit((__rlimit_resource_t)kind, &limit) == 0;
        bool refused = limits_check(&settings, &fault) == PERCUSS_BAD_REQUEST;
        if (set && refused && write(ends[1], fault.text, strlen(fault.text)) < 0)
            _exit(2);
        getrlimit((__rlimit_resource_t)kind, &limit);
        _exit(set && (kind != RLIMIT_NOFILE || refused || limit.rlim_cur >= 64) ? 0 : 1);
    }
    int status;
    close(ends[1]);
    ssize_t size = read(ends[0], text, 639);
    close(ends[0]);
    waitpid(child, &status, 0);
    assert_int_equal(status, 0);
    text[size > 0 ? size : 0] = '\0';
}

static void what_is_too_little_is_refused(void **state)
{
    (void)state;
    char text[640];
    text_under(RLIMIT_NOFILE, 8, 8, text);
    assert_string_equal(text, "file descriptors: 8 are allowed (ulimit -n, LimitNOFILE=): must be "
                              "at least 64");
    /* a soft limit is raised */
    text_under(RLIMIT_NOFILE, 8, 64, text);
    assert_string_equal(text, "");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    text_under(RLIMIT_AS, 300 * MIB, 300 * MIB, text);
    assert_non_null(strstr(text, "address space: 307200 KiB are allowed (ulimit -v or -d, "
                                 "LimitAS=): must be at least "));
    assert_non_null(strstr(text, " with 2 workers and stacks of "));
    text_under(RLIMIT_AS, 4096 * MIB, 4096 * MIB, text);
    assert_string_equal(text, "");
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(groups_of_version_2, make_root, remove_root),
        cmocka_unit_test_setup_teardown(groups_of_version_1, make_root, remove_root),
        cmocka_unit_test(caches_keep_to_what_there_is),
        cmocka_unit_test(threads_need_address_space),
        cmocka_unit_test(what_is_too_little_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
