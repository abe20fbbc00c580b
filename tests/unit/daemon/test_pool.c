/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/pool.c and daemon/job.c: every item is run once, by any worker; then the job is
 * reported and released once. */
#include <sched.h>

#include "check.h"
#include "daemon/pool.h"

enum { JOBS = 200, MOST_ITEMS = 9, WORKERS = 4 };

/* A job that counts what is done with it. */
struct toy {
    struct job job;
    atomic_int runs[MOST_ITEMS];
    atomic_int all_runs, reported, released;
    int runs_when_reported;
};

static void run(struct job *job, size_t item, struct responder *responder)
{
    struct toy *toy = (struct toy *)job;
    (void)responder;
    sched_yield();
    atomic_fetch_add(&toy->runs[item], 1);
    atomic_fetch_add(&toy->all_runs, 1);
}

static void report(struct job *job)
{
    struct toy *toy = (struct toy *)job;
    toy->runs_when_reported = atomic_load(&toy->all_runs);
    atomic_fetch_add(&toy->reported, 1);
}

static void release(struct job *job)
{
    struct toy *toy = (struct toy *)job;
    atomic_fetch_add(&toy->released, atomic_load(&toy->reported));
}

static const struct job_kind toy_kind = {.run = run, .report = report, .release = release};

static void every_job_is_run_reported_and_released(void **state)
{
    (void)state;
    static struct toy toys[JOBS];
    struct queue *queue = queue_create(8);
    struct pool *pool = pool_create(WORKERS);
    for (int i = 0; i < WORKERS; i++)
        assert_true(pool_add(pool, queue, NULL, 0));
    for (size_t i = 0; i < JOBS; i++) {
        job_init(&toys[i].job, &toy_kind, 1 + i % MOST_ITEMS);
        while (!queue_put(queue, &toys[i].job))
            sched_yield();
    }
    /* a closed queue is still emptied */
    queue_close(queue);
    pool_join(pool);
    for (size_t i = 0; i < JOBS; i++) {
        size_t items = 1 + i % MOST_ITEMS;
        for (size_t k = 0; k < MOST_ITEMS; k++)
            assert_int_equal(atomic_load(&toys[i].runs[k]), k < items);
        assert_int_equal(toys[i].runs_when_reported, items);
        assert_int_equal(atomic_load(&toys[i].reported), 1);
        assert_int_equal(atomic_load(&toys[i].released), 1);
    }
    queue_free(queue);
}

static void a_pool_may_end_without_work(void **state)
{
    (void)state;
    struct queue *queue = queue_create(1);
    struct pool *pool = pool_create(2);
    assert_true(pool_add(pool, queue, NULL, 1));
    queue_close(queue);
    pool_join(pool);
    pool_join(NULL);
    queue_free(queue);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_job_is_run_reported_and_released),
        cmocka_unit_test(a_pool_may_end_without_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
