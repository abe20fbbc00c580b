/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests memory_keep of daemon/pool.c: the memory that a thread keeps is mapped before it is used.
 */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "check.h"
#include "daemon/pool.h"

enum { BLOCKS = 512, BLOCK = 3000 };

static long faults_now(void)
{
    struct rusage usage;
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt;
}

/* Page faults of a thread that takes 1.5 MB in blocks like replies, none given back meanwhile. */
static void *take(void *argument)
{
    size_t kept = *(size_t *)argument;
    static char *blocks[BLOCKS];
    if (kept > 0)
        memory_keep(kept);
    memset(blocks, 1, sizeof blocks);
    long before = faults_now();
    for (int i = 0; i < BLOCKS; i++) {
        blocks[i] = malloc(BLOCK);
        if (blocks[i])
            memset(blocks[i], i, BLOCK);
    }
    long faults = faults_now() - before;
    for (int i = 0; i < BLOCKS; i++)
        free(blocks[i]);
    return (void *)faults;
}

static long faults_with(size_t kept)
{
    pthread_t thread;
    void *faults;
    assert_int_equal(pthread_create(&thread, NULL, take, &kept), 0);
    assert_int_equal(pthread_join(thread, &faults), 0);
    return (long)faults;
}

static void what_is_kept_is_mapped(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip(); /* their allocator is another one */
#endif
    /* 375 pages of 4 KB, by a thread whose heap is new; some the first time around for the rest */
    assert_true(faults_with(0) > 100);
    assert_true(faults_with(4 << 20) < 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_kept_is_mapped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
