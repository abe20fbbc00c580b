/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/status.c: what runs stands before what waits, the oldest first, and no more than
 * there is room for; what nobody waits for any more is left out. */
#include <string.h>

#include "check.h"
#include "daemon/queue.h"
#include "daemon/status.h"

/* A client who does not wait for what he asked. */
enum { FORGOTTEN = 99 };

struct toy {
    struct job job; /* first */
    struct task task;
};

static bool describe(const struct job *job, struct task *task)
{
    *task = ((const struct toy *)job)->task;
    return task->client[0] != FORGOTTEN;
}

static const struct job_kind told = {.describe = describe}, silent = {0};

static struct toy toy_of(uint8_t client, bool running, double arrival)
{
    struct toy toy = {.job = {.kind = &told, .items = 1},
                      .task = {.sequence = client, .running = running, .arrival = arrival}};
    toy.task.client[0] = client;
    return toy;
}

static void create(struct shared *shared)
{
    const struct reply_limits limits = {10, 1000, 10, 60.0};
    *shared = (struct shared){.replies = reply_store_create(&limits)};
    activity_create(&shared->reduction);
    for (int lane = 0; lane < LANE_COUNT; lane++)
        assert_non_null(shared->lanes[lane] = queue_create(100, QUEUE_WHOLE));
}

static void put(struct shared *shared, enum lane lane, struct toy *toy)
{
    struct job *displaced;
    assert_true(queue_put(shared->lanes[lane], &toy->job, &displaced));
}

/* Takes out what is in the lanes. */
static void release(struct shared *shared)
{
    for (int lane = 0; lane < LANE_COUNT; lane++) {
        struct job *job;
        size_t item;
        queue_close(shared->lanes[lane]);
        while ((job = queue_take(shared->lanes[lane], &item)))
            queue_done(shared->lanes[lane], job->owner, job);
        queue_free(shared->lanes[lane]);
    }
    activity_release(&shared->reduction);
    reply_store_free(shared->replies);
}

static void orders_what_all_lanes_have(void **state)
{
    (void)state;
    struct shared shared;
    struct tasks tasks;
    struct toy toys[] = {toy_of(1, false, 3.0), toy_of(2, true, 4.0), toy_of(3, false, 2.0),
                         toy_of(4, true, 5.0), toy_of(5, false, 1.0)};
    const uint64_t order[] = {2, 4, 3, 1};
    create(&shared);
    tasks_look(&shared, &tasks);
    assert_int_equal(tasks.count, 0);
    assert_int_equal(tasks.all, 0);
    /* the last one is of a kind that nobody is told of */
    toys[4].job.kind = &silent;
    for (size_t i = 0; i < 5; i++)
        put(&shared, (enum lane)i, &toys[i]);
    tasks_look(&shared, &tasks);
    assert_int_equal(tasks.count, 4);
    assert_int_equal(tasks.all, 4);
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(tasks.list[i].sequence, order[i]);
    release(&shared);
}

static void lists_as_many_as_there_is_room_for(void **state)
{
    (void)state;
    struct shared shared;
    struct tasks tasks;
    struct toy toys[40];
    create(&shared);
    for (size_t i = 0; i < 40; i++) {
        toys[i] = toy_of((uint8_t)(i + 1), i == 39, 100.0 - (double)i);
        put(&shared, LANE_SHORT, &toys[i]);
    }
    tasks_look(&shared, &tasks);
    assert_int_equal(tasks.count, TASKS_LISTED);
    assert_int_equal(tasks.all, 40);
    /* the one that runs, and then those that have waited longest: the last ones that came in here
     */
    for (size_t i = 0; i < TASKS_LISTED; i++)
        assert_int_equal(tasks.list[i].sequence, 40 - i);
    release(&shared);
}

static void leaves_out_what_waits_for_nobody(void **state)
{
    (void)state;
    struct shared shared;
    struct tasks tasks;
    struct toy waits = toy_of(1, false, 1.0), runs = toy_of(1, true, 2.0);
    struct toy forgotten = toy_of(FORGOTTEN, true, 1.0);
    create(&shared);
    put(&shared, LANE_SHORT, &forgotten);
    put(&shared, LANE_SHORT, &waits);
    put(&shared, LANE_LONG, &runs);
    reply_store_set_present(shared.replies, waits.task.client, true, 1.0);
    tasks_look(&shared, &tasks);
    assert_int_equal(tasks.all, 2);
    reply_store_set_present(shared.replies, waits.task.client, false, 2.0);
    tasks_look(&shared, &tasks);
    assert_int_equal(tasks.all, 1);
    assert_true(tasks.list[0].running);
    release(&shared);
}

static void tells_of_a_reduction(void **state)
{
    (void)state;
    struct shared shared;
    struct tasks tasks;
    create(&shared);
    activity_set(&shared.reduction, &tasks, 0.25, "reducing a bracket");
    tasks_look(&shared, &tasks);
    assert_int_equal(tasks.all, 1);
    assert_int_equal(tasks.list[0].kind, percuss_v1_TASK_MESH);
    assert_true(tasks.list[0].done == 0.25);
    release(&shared);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_what_all_lanes_have),
        cmocka_unit_test(lists_as_many_as_there_is_room_for),
        cmocka_unit_test(leaves_out_what_waits_for_nobody),
        cmocka_unit_test(tells_of_a_reduction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
