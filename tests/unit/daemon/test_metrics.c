/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Counting from several threads loses nothing, and the text says what was counted. */
#include "daemon/metrics.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

enum { THREADS = 4, EACH = 100000 };

static void *note_many(void *argument)
{
    struct metrics *metrics = argument;
    for (int i = 0; i < EACH; i++) {
        metrics_note_time(&metrics->solves, 0.5);
        metrics_count_refusal(metrics, EXCHANGE_SINGLE, PERCUSS_BUSY);
    }
    return NULL;
}

static void threads_lose_nothing(void **state)
{
    (void)state;
    static struct metrics metrics;
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, note_many, &metrics), 0);
    for (int i = 0; i < THREADS; i++)
        pthread_join(threads[i], NULL);
    assert_int_equal(atomic_load(&metrics.replies[EXCHANGE_SINGLE][PERCUSS_BUSY]), THREADS * EACH);
    /* halves: the sum is exact */
    assert_true(atomic_load(&metrics.solves.sum) == 0.5 * THREADS * EACH);
}

/* The text of the histograms; the caller frees it. */
static char *print(const struct metrics *metrics)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    metrics_print_histograms(metrics, file);
    fclose(file);
    return text;
}

static void bounds_are_part_of_their_bucket(void **state)
{
    (void)state;
    static struct metrics metrics;
    metrics_note_time(&metrics.waits, 0.0);
    metrics_note_time(&metrics.waits, 1e-3);
    metrics_note_time(&metrics.waits, 1.0000001e-3);
    metrics_note_time(&metrics.waits, 1e4);
    char *text = print(&metrics);
    assert_non_null(strstr(text, "percuss_wait_seconds_bucket{le=\"0.0003\"} 1\n"));
    assert_non_null(strstr(text, "percuss_wait_seconds_bucket{le=\"0.001\"} 2\n"));
    assert_non_null(strstr(text, "percuss_wait_seconds_bucket{le=\"0.003\"} 3\n"));
    assert_non_null(strstr(text, "percuss_wait_seconds_bucket{le=\"300\"} 3\n"));
    assert_non_null(strstr(text, "percuss_wait_seconds_bucket{le=\"+Inf\"} 4\n"));
    assert_non_null(strstr(text, "percuss_wait_seconds_count 4\n"));
    free(text);
}

static void an_answer_is_counted_once(void **state)
{
    (void)state;
    static struct metrics metrics;
    percuss_v1_Reply replies[2] = {{.status = PERCUSS_OK}, {.status = PERCUSS_NOT_APPROACHING}};
    replies[0].timing.solve = 2e-5;
    replies[0].energy.available = 2.0;
    replies[0].energy.closure = -2e-6;
    struct answer answer = {.exchange = EXCHANGE_BATCH, .reply = replies, .member_count = 2};
    metrics_count(&metrics, &answer);
    assert_int_equal(atomic_load(&metrics.replies[EXCHANGE_BATCH][PERCUSS_OK]), 1);
    assert_int_equal(atomic_load(&metrics.replies[EXCHANGE_BATCH][PERCUSS_NOT_APPROACHING]), 1);
    char *text = print(&metrics);
    /* what was not solved took no time */
    assert_non_null(strstr(text, "percuss_solve_seconds_count 1\n"));
    assert_non_null(strstr(text, "percuss_energy_closure_ratio_bucket{le=\"1e-06\"} 1\n"));
    assert_non_null(strstr(text, "percuss_energy_closure_ratio_bucket{le=\"3e-07\"} 0\n"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_lose_nothing),
        cmocka_unit_test(bounds_are_part_of_their_bucket),
        cmocka_unit_test(an_answer_is_counted_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
