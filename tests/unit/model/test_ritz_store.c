/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/ritz_store.c: computed once for all threads, stopped, held and forgotten.
 */
#include "model/ritz_store.h"

#include <pthread.h>
#include <stdatomic.h>

#include "base/watch.h"
#include "check.h"

enum { LITTLE = 48 << 20 };
static const struct ritz_shape cube = {.side = {1.0, 0.9, 0.8}};

/* Lets the first thread begin, and stops it once the other one waits. */
struct meeting {
    atomic_bool begun, waits;
};

struct asker {
    struct ritz_store *store;
    struct meeting *meeting;
    struct ritz_box *box;
    pthread_t thread;
};

static void *ask(void *context)
{
    struct asker *asker = context;
    asker->box = ritz_store_hold(asker->store, &cube, 0.3, NULL);
    return NULL;
}

static void threads_share_one(void **state)
{
    (void)state;
    struct ritz_store *store = ritz_store_create(LITTLE);
    struct asker askers[4];
    for (int i = 0; i < 4; i++) {
        askers[i] = (struct asker){.store = store};
        assert_int_equal(pthread_create(&askers[i].thread, NULL, ask, &askers[i]), 0);
    }
    for (int i = 0; i < 4; i++) {
        assert_int_equal(pthread_join(askers[i].thread, NULL), 0);
        assert_non_null(askers[i].box);
        assert_ptr_equal(askers[i].box, askers[0].box);
    }
    assert_int_equal(ritz_store_computed(store), 1);
    /* the same bits as alone */
    struct ritz *alone = ritz_create(&cube, 0.3, NULL);
    struct ritz_box *box = askers[0].box;
    const struct ritz *shared = ritz_box_vibration(box);
    const double middle[3] = {0.0, 0.0, 0.4};
    assert_int_equal(ritz_mode_count(alone), ritz_mode_count(shared));
    assert_memory_equal(ritz_omega(alone), ritz_omega(shared),
                        ritz_mode_count(alone) * sizeof(double));
    double known = ritz_flexibility(alone, 2, 1, middle);
    assert_true(known != 0.0);
    for (int again = 0; again < 2; again++)
        assert_true(ritz_box_flexibility(store, box, 2, 1, middle) == known);
    ritz_free(alone);
    for (int i = 0; i < 4; i++)
        ritz_store_release(store, box);
    ritz_store_free(store);
    ritz_store_free(NULL);
    assert_null(ritz_store_share(NULL));
}

static bool stops(void *context, double done)
{
    struct meeting *meeting = context;
    (void)done;
    atomic_store(&meeting->begun, true);
    return !atomic_load(&meeting->waits);
}

static void *ask_and_stop(void *context)
{
    struct asker *asker = context;
    struct watch watch = {stops, asker->meeting};
    struct pace pace = {.watch = &watch};
    asker->box = ritz_store_hold(asker->store, &cube, 0.3, &pace);
    assert_true(asker->box || pace.stopped);
    return NULL;
}

static bool notes(void *context, double done)
{
    struct meeting *meeting = context;
    (void)done;
    atomic_store(&meeting->waits, true);
    return true;
}

/* Where the thread that computes is stopped the one that waits goes on. */
static void a_stopped_one_is_replaced(void **state)
{
    (void)state;
    struct ritz_store *store = ritz_store_create(LITTLE);
    struct meeting meeting = {false, false};
    struct asker first = {.store = store, .meeting = &meeting};
    assert_int_equal(pthread_create(&first.thread, NULL, ask_and_stop, &first), 0);
    while (!atomic_load(&meeting.begun))
        ;
    struct watch watch = {notes, &meeting};
    struct pace pace = {.watch = &watch};
    struct ritz_box *box = ritz_store_hold(store, &cube, 0.3, &pace);
    assert_non_null(box);
    assert_int_equal(pthread_join(first.thread, NULL), 0);
    assert_int_equal(ritz_store_computed(store), 1);
    assert_true(ritz_mode_count(ritz_box_vibration(box)) > 10);
    assert_true(2 * ritz_size(ritz_box_vibration(box)) < LITTLE);
    ritz_store_release(store, box);
    if (first.box)
        ritz_store_release(store, box);
    ritz_store_free(store);
}

static bool never(void *context, double done)
{
    (void)context;
    (void)done;
    return false;
}

/* Nothing is left of it, and the next one begins anew. */
static void nothing_is_left_of_a_stopped_one(void **state)
{
    (void)state;
    struct ritz_store *store = ritz_store_create(LITTLE);
    struct watch watch = {never, NULL};
    struct pace pace = {.watch = &watch};
    assert_null(ritz_store_hold(store, &cube, 0.3, &pace));
    assert_int_equal(ritz_store_computed(store), 0);
    struct ritz_box *box = ritz_store_hold(store, &cube, 0.3, NULL);
    assert_non_null(box);
    ritz_store_release(store, box);
    ritz_store_free(store);
}

/* A second owner keeps it; what nobody holds is found again while there is room, and only then. */
static void memory_is_bounded(void **state)
{
    (void)state;
    struct ritz_store *store = ritz_store_create(LITTLE);
    struct ritz_store *other = ritz_store_share(store);
    ritz_store_free(other);
    struct ritz_box *kept = ritz_store_hold(store, &cube, 0.3, NULL);
    size_t bytes = 0; /* of all that were made */
    unsigned long made = 1;
    for (; bytes < 2 * LITTLE; made++) {
        const struct ritz_shape another = {.side = {1.0, 0.99, 0.7 + 0.001 * (double)made}};
        struct ritz_box *box = ritz_store_hold(store, &another, 0.3, NULL);
        assert_non_null(box);
        bytes += ritz_size(ritz_box_vibration(box));
        ritz_store_release(store, box);
        /* found again at once */
        ritz_store_release(store, ritz_store_hold(store, &another, 0.3, NULL));
        assert_int_equal(ritz_store_computed(store), made + 1);
    }
    /* the first one of them is gone, the one that is held is not */
    const struct ritz_shape first = {.side = {1.0, 0.99, 0.701}};
    ritz_store_release(store, ritz_store_hold(store, &first, 0.3, NULL));
    assert_int_equal(ritz_store_computed(store), made + 1);
    struct ritz_box *again = ritz_store_hold(store, &cube, 0.3, NULL);
    assert_ptr_equal(again, kept);
    ritz_store_release(store, again);
    ritz_store_release(store, kept);
    ritz_store_free(store);
}

/* The same sides held otherwise are another box. */
static void held_ends_are_told_apart(void **state)
{
    (void)state;
    struct ritz_store *store = ritz_store_create(4 * LITTLE);
    struct ritz_box *boxes[4];
    for (int round = 0; round < 2; round++)
        for (int ends = 0; ends < 4; ends++) {
            const struct ritz_shape shape = {.side = {1.0, 0.3, 0.3}, .held = {ends & 1, ends & 2}};
            struct ritz_box *box = ritz_store_hold(store, &shape, 0.3, NULL);
            assert_non_null(box);
            if (round == 0)
                boxes[ends] = box;
            assert_ptr_equal(box, boxes[ends]);
        }
    assert_int_equal(ritz_store_computed(store), 4);
    for (int k = 0; k < 8; k++)
        ritz_store_release(store, boxes[k / 2]);
    ritz_store_free(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_share_one),
        cmocka_unit_test(a_stopped_one_is_replaced),
        cmocka_unit_test(nothing_is_left_of_a_stopped_one),
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(held_ends_are_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
