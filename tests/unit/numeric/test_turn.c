/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests the turns of numeric/linear.c: band matrices factored in several threads at once have the
 * factors that they have alone, bit for bit. Without turns some are wrong within seconds. */

#include <pthread.h>
#include <string.h>

#include "check.h"
#include "numeric/band.h"

enum { N = 200, WIDTH = 90, THREADS = 4, ROUNDS = 300 };

/* Diagonally dominant, another one for each seed. */
static void fill(double *values, unsigned seed)
{
    struct band band = {.n = N, .width = WIDTH, .values = values};
    for (size_t j = 0; j < N; j++)
        for (size_t i = j; i <= j + WIDTH && i < N; i++)
            *band_entry(&band, i, j) =
                i == j ? 200.0 : sin((double)(seed + 1) * (double)(i + 3 * j));
}

struct work {
    unsigned seed;
    double values[N * (WIDTH + 1)], expected[N * (WIDTH + 1)];
    int wrong;
};

static void factor(struct work *work, double *values)
{
    struct band band = {.n = N, .width = WIDTH, .values = values};
    memset(values, 0, sizeof work->values);
    fill(values, work->seed);
    work->wrong += !band_factor(&band);
}

static void *factor_often(void *context)
{
    struct work *work = context;
    for (int i = 0; i < ROUNDS; i++) {
        factor(work, work->values);
        work->wrong += memcmp(work->values, work->expected, sizeof work->values) != 0;
    }
    return NULL;
}

static void test_threads_do_not_disturb_each_other(void **state)
{
    static struct work work[THREADS];
    pthread_t threads[THREADS];
    (void)state;
    for (unsigned i = 0; i < THREADS; i++) {
        work[i].seed = i;
        factor(&work[i], work[i].expected);
    }
    for (unsigned i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, factor_often, &work[i]), 0);
    for (unsigned i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        assert_int_equal(work[i].wrong, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_threads_do_not_disturb_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
