/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/queue.c beside test_queue.c: draining. */
#include <pthread.h>
#include <time.h>

#include "exchange/clock.h"
#include "unit/daemon/queued.h"

static void is_drained_when_all_is_done(void **state)
{
    (void)state;
    struct job batch = job_of(2);
    struct queue *queue = queue_create(4, QUEUE_WHOLE);
    assert_true(queue_drain(queue, 0.0));
    assert_true(put(queue, &batch));
    assert_false(queue_drain(queue, 0.0)); /* waits */
    takes(queue, &batch, 0);
    takes(queue, &batch, 1);
    queue_done(queue, NOBODY, NULL);
    double start = clock_now();
    assert_false(queue_drain(queue, 0.05)); /* one still runs */
    assert_true(clock_now() - start >= 0.05);
    queue_done(queue, NOBODY, &batch);
    assert_true(queue_drain(queue, 0.0));
    queue_free(queue);
}

static void a_drained_queue_may_have_lost_its_last_job(void **state)
{
    (void)state;
    static const struct job_kind named = {.withdraw = is_called};
    static const uint8_t client[16] = {7};
    struct job job = job_of(1), *withdrawn;
    size_t item;
    struct queue *queue = queue_create(1, QUEUE_WHOLE);
    job.kind = &named;
    job.owner = digest_of_octets(client);
    assert_true(put(queue, &job));
    queue_close(queue);
    assert_true(
        queue_withdraw(queue, &(struct request_name){client, EXCHANGE_SINGLE, 1}, &withdrawn));
    assert_ptr_equal(withdrawn, &job);
    assert_true(queue_drain(queue, 60.0));
    assert_null(queue_take(queue, &item));
    queue_free(queue);
}

static void *done_later(void *queue)
{
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    queue_done(queue, NOBODY, NULL);
    return NULL;
}

static void draining_ends_with_the_last_request(void **state)
{
    (void)state;
    struct job job = job_of(1);
    pthread_t thread;
    struct queue *queue = queue_create(1, QUEUE_WHOLE);
    assert_true(put(queue, &job));
    takes(queue, &job, 0);
    assert_int_equal(pthread_create(&thread, NULL, done_later, queue), 0);
    /* within seconds of a minute: it is woken */
    double start = clock_now();
    assert_true(queue_drain(queue, 60.0));
    assert_true(clock_now() - start < 30.0);
    pthread_join(thread, NULL);
    queue_free(queue);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_drained_when_all_is_done),
        cmocka_unit_test(a_drained_queue_may_have_lost_its_last_job),
        cmocka_unit_test(draining_ends_with_the_last_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
