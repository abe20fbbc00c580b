/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/shared.c: who is cancelled, and who waits. */
#include <string.h>

#include "check.h"
#include "daemon/shared.h"

static const uint8_t one[16] = {1}, other[16] = {2};

static void count_one(void *context, const struct ensemble_entry *waiting)
{
    uint64_t *sum = context;
    *sum += waiting->samples;
}

static void cancels_the_one_that_is_named(void **state)
{
    (void)state;
    struct ensembles ensembles;
    struct ensemble_entry entries[3] = {
        {.client = one, .sequence = 5, .samples = 1},
        {.client = one, .sequence = 6, .samples = 10},
        {.client = other, .sequence = 6, .samples = 100},
    };
    ensembles_create(&ensembles);
    for (int i = 0; i < 3; i++)
        ensembles_enter(&ensembles, &entries[i]);
    ensembles_cancel(&ensembles, one, 7);
    ensembles_cancel(&ensembles, one, 6);
    assert_false(atomic_load(&entries[0].cancelled));
    assert_true(atomic_load(&entries[1].cancelled));
    assert_false(atomic_load(&entries[2].cancelled));
    uint64_t sum = 0;
    atomic_store(&entries[0].running, true);
    ensembles_visit_waiting(&ensembles, count_one, &sum);
    assert_int_equal(sum, 110);
    /* who has left is neither cancelled nor does he wait */
    ensembles_leave(&ensembles, &entries[2]);
    ensembles_cancel(&ensembles, other, 6);
    assert_false(atomic_load(&entries[2].cancelled));
    sum = 0;
    ensembles_visit_waiting(&ensembles, count_one, &sum);
    assert_int_equal(sum, 10);
    ensembles_release(&ensembles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cancels_the_one_that_is_named)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
