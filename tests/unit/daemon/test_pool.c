/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/pool.c, daemon/job.c and daemon/errand.c: every item is run once, by any worker;
 * then the job is reported and released once. */
#include <pthread.h>
#include <sched.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "check.h"
#include "daemon/pool.h"

enum { JOBS = 200, MOST_ITEMS = 9, WORKERS = 4, PATIENT = 19 };

/* A job that counts what is done with it. */
struct toy {
    struct job job;
    atomic_int runs[MOST_ITEMS];
    atomic_int refusals;
    atomic_int all_runs, reported, released;
    int runs_when_reported;
};

static bool run(struct job *job, size_t item, struct responder *responder)
{
    struct toy *toy = (struct toy *)job;
    (void)responder;
    sched_yield();
    atomic_fetch_add(&toy->runs[item], 1);
    atomic_fetch_add(&toy->all_runs, 1);
    return true;
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
    struct job *displaced;
    struct queue *queue = queue_create(1000, QUEUE_WHOLE);
    struct pool *pool = pool_create(WORKERS);
    for (int i = 0; i < WORKERS; i++)
        assert_true(pool_add(pool, queue, NULL, NULL, 0));
    for (size_t i = 0; i < JOBS; i++) {
        job_init(&toys[i].job, &toy_kind, 1 + i % MOST_ITEMS, (struct digest){i % 3, 0});
        while (!queue_put(queue, &toys[i].job, &displaced))
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

/* Also where the whole program is of low priority, and all its threads with it. */
static bool is_patient(void)
{
    char name[16] = "";
    pthread_getname_np(pthread_self(), name, sizeof name);
    return strcmp(name, "long") == 0 && getpriority(PRIO_PROCESS, (id_t)gettid()) == PATIENT;
}

/* Gives up every other item, but in the workers of low priority. */
static bool run_hesitantly(struct job *job, size_t item, struct responder *responder)
{
    if (item % 2 == 0 && !is_patient())
        return false;
    return run(job, item, responder);
}

static void refuse(struct job *job, size_t item)
{
    struct toy *toy = (struct toy *)job;
    atomic_fetch_add(&toy->refusals, 1);
    run(job, item, NULL);
}

static const struct job_kind hesitant_kind = {
    .run = run_hesitantly, .refuse = refuse, .report = report, .release = release};

/* What is given up is done by the slower workers, or refused where they have no room for it; the
 * job ends once, whoever does its last item. */
static int all_refusals(size_t room)
{
    static struct toy toys[JOBS];
    struct job *displaced;
    int refusals = 0;
    struct queue *queue = queue_create(1000, QUEUE_WHOLE), *slow = queue_create(room, QUEUE_WHOLE);
    struct pool *pool = pool_create(WORKERS), *slow_pool = pool_create(WORKERS);
    memset(toys, 0, sizeof toys);
    for (int i = 0; i < WORKERS; i++) {
        assert_true(pool_add(pool, queue, slow, NULL, 0));
        assert_true(pool_add(slow_pool, slow, NULL, NULL, PATIENT));
    }
    for (size_t i = 0; i < JOBS; i++) {
        job_init(&toys[i].job, &hesitant_kind, 1 + i % MOST_ITEMS, (struct digest){i % 3, 0});
        assert_true(queue_put(queue, &toys[i].job, &displaced));
    }
    assert_true(queue_drain(queue, 60.0));
    assert_true(queue_drain(slow, 60.0));
    queue_close(queue);
    queue_close(slow);
    pool_join(pool);
    pool_join(slow_pool);
    for (size_t i = 0; i < JOBS; i++) {
        assert_int_equal(atomic_load(&toys[i].all_runs), 1 + i % MOST_ITEMS);
        assert_int_equal(toys[i].runs_when_reported, 1 + i % MOST_ITEMS);
        assert_int_equal(atomic_load(&toys[i].released), 1);
        refusals += atomic_load(&toys[i].refusals);
    }
    queue_free(queue);
    queue_free(slow);
    return refusals;
}

static void what_is_given_up_is_done_elsewhere(void **state)
{
    (void)state;
    assert_int_equal(all_refusals(10000), 0);
}

static void what_finds_no_room_is_refused(void **state)
{
    (void)state;
    assert_true(all_refusals(1) > 0);
}

static void a_pool_may_end_without_work(void **state)
{
    (void)state;
    struct queue *queue = queue_create(1, QUEUE_WHOLE);
    struct pool *pool = pool_create(2);
    assert_true(pool_add(pool, queue, NULL, NULL, 1));
    queue_close(queue);
    pool_join(pool);
    pool_join(NULL);
    queue_free(queue);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_given_up_is_done_elsewhere),
        cmocka_unit_test(what_finds_no_room_is_refused),
        cmocka_unit_test(every_job_is_run_reported_and_released),
        cmocka_unit_test(a_pool_may_end_without_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
