/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/queue.c: order, turns of clients and batches, refusal when full or closed, threads.
 */
#include <pthread.h>

#include "unit/daemon/queued.h"

static void hands_out_in_order_and_refuses_when_full(void **state)
{
    (void)state;
    struct job jobs[4] = {job_of(1), job_of(1), job_of(1), job_of(1)};
    struct queue *queue = queue_create(3, QUEUE_WHOLE);
    /* more often round than the ring is long */
    for (int round = 0; round < 5; round++) {
        for (int i = 0; i < 3; i++)
            assert_true(put(queue, &jobs[i]));
        assert_false(put(queue, &jobs[3]));
        assert_int_equal(queue_length(queue), 3);
        takes(queue, &jobs[0], 0);
        assert_true(put(queue, &jobs[3]));
        for (int i = 1; i < 4; i++)
            takes(queue, &jobs[i], 0);
        assert_int_equal(queue_length(queue), 0);
        for (int i = 0; i < 4; i++) {
            jobs[i].next = 0;
            queue_done(queue, NOBODY, &jobs[i]);
        }
    }
    queue_free(queue);
}

static void a_batch_lets_others_in_between(void **state)
{
    (void)state;
    struct job batch = job_of(3), single = job_of(1), pair = job_of(2);
    struct queue *queue = queue_create(3, QUEUE_WHOLE);
    assert_true(put(queue, &batch));
    assert_true(put(queue, &single));
    assert_true(put(queue, &pair));
    takes(queue, &batch, 0);
    assert_int_equal(queue_length(queue), 3); /* its rest still counts as one */
    takes(queue, &single, 0);
    takes(queue, &pair, 0);
    takes(queue, &batch, 1);
    takes(queue, &pair, 1);
    takes(queue, &batch, 2);
    assert_int_equal(queue_length(queue), 0);
    finish(queue, &single);
    finish(queue, &pair);
    finish(queue, &batch);
    queue_free(queue);
}

static void a_closed_queue_gives_what_it_has(void **state)
{
    (void)state;
    struct job batch = job_of(2), late = job_of(1);
    size_t index;
    struct queue *queue = queue_create(4, QUEUE_WHOLE);
    assert_true(put(queue, &batch));
    queue_close(queue);
    assert_false(put(queue, &late));
    takes(queue, &batch, 0);
    takes(queue, &batch, 1);
    assert_null(queue_take(queue, &index));
    assert_null(queue_take(queue, &index));
    finish(queue, &batch);
    queue_free(queue);
}

static void clients_take_turns(void **state)
{
    (void)state;
    struct job flood[4], other[2];
    struct queue *queue = queue_create(8, QUEUE_WHOLE);
    for (int i = 0; i < 4; i++) {
        flood[i] = job_of_client(1);
        assert_true(put(queue, &flood[i]));
    }
    for (int i = 0; i < 2; i++) {
        other[i] = job_of_client(2 + (uint64_t)i);
        assert_true(put(queue, &other[i]));
    }
    takes(queue, &flood[0], 0);
    assert_true(queue_others_wait(queue, &flood[0]));
    takes(queue, &other[0], 0);
    takes(queue, &other[1], 0);
    takes(queue, &flood[1], 0);
    assert_false(queue_others_wait(queue, &flood[1]));
    assert_true(queue_others_wait(queue, &other[0]));
    takes(queue, &flood[2], 0);
    takes(queue, &flood[3], 0);
    assert_false(queue_others_wait(queue, &other[0]));
    for (int i = 0; i < 4; i++)
        queue_done(queue, flood[i].owner, &flood[i]);
    for (int i = 0; i < 2; i++)
        queue_done(queue, other[i].owner, &other[i]);
    queue_free(queue);
}

static void a_full_queue_has_room_for_who_has_less(void **state)
{
    (void)state;
    struct job flood[5], other[3], *displaced;
    struct queue *queue = queue_create(4, QUEUE_WHOLE);
    for (int i = 0; i < 5; i++)
        flood[i] = job_of_client(1);
    for (int i = 0; i < 3; i++)
        other[i] = job_of_client(2);
    for (int i = 0; i < 4; i++)
        assert_true(put(queue, &flood[i]));
    assert_false(put(queue, &flood[4]));
    /* until both have as many */
    assert_true(queue_put(queue, &other[0], &displaced));
    assert_ptr_equal(displaced, &flood[3]);
    assert_true(queue_put(queue, &other[1], &displaced));
    assert_ptr_equal(displaced, &flood[2]);
    assert_false(put(queue, &other[2]));
    assert_false(put(queue, &flood[4]));
    assert_int_equal(queue_length(queue), 4);
    takes(queue, &flood[0], 0);
    takes(queue, &other[0], 0);
    takes(queue, &flood[1], 0);
    takes(queue, &other[1], 0);
    for (int i = 0; i < 2; i++) {
        queue_done(queue, flood[i].owner, &flood[i]);
        queue_done(queue, other[i].owner, &other[i]);
    }
    queue_free(queue);
}

static void what_has_begun_does_not_give_way(void **state)
{
    (void)state;
    struct job batch = {.items = 3, .owner = {1, 0}}, other = job_of_client(2);
    struct queue *queue = queue_create(1, QUEUE_WHOLE);
    assert_true(put(queue, &batch));
    takes(queue, &batch, 0);
    assert_false(put(queue, &other));
    takes(queue, &batch, 1);
    takes(queue, &batch, 2);
    for (int i = 0; i < 3; i++)
        queue_done(queue, batch.owner, i == 2 ? &batch : NULL);
    queue_free(queue);
}

static void a_client_has_his_share_of_workers(void **state)
{
    (void)state;
    struct job flood[3], other = job_of_client(2);
    struct queue *queue = queue_create(4, 2);
    for (int i = 0; i < 3; i++) {
        flood[i] = job_of_client(1);
        assert_true(put(queue, &flood[i]));
    }
    assert_true(put(queue, &other));
    takes(queue, &flood[0], 0);
    takes(queue, &other, 0);
    takes(queue, &flood[1], 0);
    /* the third one waits for the end of one of the others */
    queue_done(queue, flood[0].owner, &flood[0]);
    takes(queue, &flood[2], 0);
    queue_done(queue, flood[1].owner, &flood[1]);
    queue_done(queue, flood[2].owner, &flood[2]);
    queue_done(queue, other.owner, &other);
    queue_free(queue);
}

static int cancelled;

static void note_cancelled(struct job *job)
{
    cancelled += (int)job->items;
}

static void cancels_what_waits_and_what_runs(void **state)
{
    (void)state;
    static const struct job_kind patient = {.cancel = note_cancelled}, quick = {0};
    struct job ended = job_of(1), running = job_of(10), waiting = job_of(100), other = job_of(1);
    struct queue *queue = queue_create(4, QUEUE_WHOLE);
    ended.kind = running.kind = waiting.kind = &patient;
    other.kind = &quick;
    assert_true(put(queue, &ended));
    assert_true(put(queue, &running));
    assert_true(put(queue, &waiting));
    assert_true(put(queue, &other));
    takes(queue, &ended, 0);
    takes(queue, &running, 0);
    queue_done(queue, NOBODY, &ended);
    queue_cancel(queue);
    assert_int_equal(cancelled, 110);
    assert_false(put(queue, &ended));
    /* what waits is still handed out, to say so */
    takes(queue, &waiting, 0);
    for (size_t index; queue_length(queue) > 0;)
        assert_non_null(queue_take(queue, &index));
    finish(queue, &running);
    finish(queue, &waiting);
    finish(queue, &other);
    queue_free(queue);
}

static void gives_back_what_is_not_wanted_and_has_not_begun(void **state)
{
    (void)state;
    static const struct job_kind named = {.withdraw = is_called}, nameless = {0};
    static const uint8_t client[16] = {7}, other[16] = {8};
    struct job running = job_of(3), first = job_of(1), last = job_of(2), clear = job_of(1);
    struct job *withdrawn;
    struct queue *queue = queue_create(4, QUEUE_WHOLE);
    running.kind = first.kind = last.kind = &named;
    clear.kind = &nameless;
    running.owner = first.owner = last.owner = clear.owner = digest_of_octets(client);
    assert_true(put(queue, &running));
    takes(queue, &running, 0);
    assert_true(put(queue, &clear));
    assert_true(put(queue, &first));
    assert_true(put(queue, &last));
    assert_int_equal(queue_length(queue), 4);
    /* nobody else's, nothing that is not there */
    assert_false(
        queue_withdraw(queue, &(struct request_name){other, EXCHANGE_SINGLE, 1}, &withdrawn));
    assert_false(
        queue_withdraw(queue, &(struct request_name){client, EXCHANGE_SINGLE, 9}, &withdrawn));
    /* what has begun is told only */
    assert_true(
        queue_withdraw(queue, &(struct request_name){client, EXCHANGE_SINGLE, 3}, &withdrawn));
    assert_null(withdrawn);
    assert_true(
        queue_withdraw(queue, &(struct request_name){client, EXCHANGE_SINGLE, 1}, &withdrawn));
    assert_ptr_equal(withdrawn, &first);
    assert_int_equal(queue_length(queue), 3);
    /* the others have their turns as before */
    takes(queue, &running, 1);
    takes(queue, &clear, 0);
    takes(queue, &last, 0);
    takes(queue, &running, 2);
    takes(queue, &last, 1);
    /* all six items end, so that the client's own queue goes */
    for (int i = 0; i < 6; i++)
        queue_done(queue, last.owner, i == 0 ? &running : i == 1 ? &clear : i == 2 ? &last : NULL);
    queue_free(queue);
}

enum { WORKERS = 4, JOBS = 500, MOST_REQUESTS = 7 };

struct crowd {
    struct queue *queue;
    struct job jobs[JOBS];
    atomic_int taken[JOBS][MOST_REQUESTS];
};

static void *take_all(void *argument)
{
    struct crowd *crowd = argument;
    struct job *job;
    size_t index;
    while ((job = queue_take(crowd->queue, &index))) {
        atomic_fetch_add(&crowd->taken[job - crowd->jobs][index], 1);
        queue_done(crowd->queue, NOBODY, NULL);
    }
    return NULL;
}

static void threads_take_every_request_once(void **state)
{
    (void)state;
    static struct crowd crowd;
    pthread_t threads[WORKERS];
    crowd.queue = queue_create(8, QUEUE_WHOLE);
    for (int i = 0; i < WORKERS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, take_all, &crowd), 0);
    for (size_t i = 0; i < JOBS; i++) {
        crowd.jobs[i] = job_of(1 + i % MOST_REQUESTS);
        while (!put(crowd.queue, &crowd.jobs[i]))
            sched_yield();
    }
    assert_true(queue_drain(crowd.queue, 60.0));
    queue_close(crowd.queue); /* wakes those that wait for more */
    for (int i = 0; i < WORKERS; i++)
        pthread_join(threads[i], NULL);
    for (size_t i = 0; i < JOBS; i++) {
        for (size_t j = 0; j < MOST_REQUESTS; j++)
            assert_int_equal(atomic_load(&crowd.taken[i][j]), j < crowd.jobs[i].items);
    }
    queue_free(crowd.queue);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hands_out_in_order_and_refuses_when_full),
        cmocka_unit_test(a_batch_lets_others_in_between),
        cmocka_unit_test(a_closed_queue_gives_what_it_has),
        cmocka_unit_test(clients_take_turns),
        cmocka_unit_test(a_full_queue_has_room_for_who_has_less),
        cmocka_unit_test(what_has_begun_does_not_give_way),
        cmocka_unit_test(a_client_has_his_share_of_workers),
        cmocka_unit_test(cancels_what_waits_and_what_runs),
        cmocka_unit_test(gives_back_what_is_not_wanted_and_has_not_begun),
        cmocka_unit_test(threads_take_every_request_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
