/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/random_stream.c: the published vector of Philox 4x64-10, uniformity, and
 * permutations. */
#include <string.h>

#include "check.h"
#include "numeric/random_stream.h"

/* Random123's kat_vectors: counter and key zero. */
static void is_philox(void **state)
{
    (void)state;
    struct random_stream stream = {0, 0};
    assert_true(random_bits(&stream, 0, 0) == UINT64_C(0x16554d9eca36314c));
    assert_true(random_bits(&stream, 0, 1) == UINT64_C(0xdb20fe9d672d0fdc));
    assert_true(random_bits(&stream, 0, 2) == UINT64_C(0xd7e772cee186176b));
    assert_true(random_bits(&stream, 0, 3) == UINT64_C(0x7e68b68aec7ba23b));
}

static void depends_on_everything(void **state)
{
    (void)state;
    struct random_stream a = {1, 0}, b = {2, 0}, c = {1, 1};
    uint64_t bits = random_bits(&a, 7, 3);
    assert_true(bits == random_bits(&a, 7, 3));
    assert_true(bits != random_bits(&b, 7, 3));
    assert_true(bits != random_bits(&c, 7, 3));
    assert_true(bits != random_bits(&a, 8, 3));
    assert_true(bits != random_bits(&a, 7, 4));
}

/* Neither end occurs, and the moments are those of a uniform distribution: of n numbers the mean
 * has the deviation 1/sqrt(12 n), the mean square sqrt(4/45/n); five of them are allowed. */
static void is_uniform(void **state)
{
    (void)state;
    enum { N = 100000 };
    struct random_stream stream = {42, 0};
    double sum = 0.0, squares = 0.0;
    for (uint64_t i = 0; i < N; i++) {
        double u = random_uniform(&stream, i, 0);
        assert_true(u > 0.0 && u < 1.0);
        sum += u;
        squares += u * u;
    }
    assert_true(fabs(sum / N - 0.5) < 5.0 / sqrt(12.0 * N));
    assert_true(fabs(squares / N - 1.0 / 3.0) < 5.0 * sqrt(4.0 / 45.0 / N));
    assert_true(random_uniform_of(0) > 0.0 && random_uniform_of(UINT64_MAX) < 1.0);
}

static void permutes(void **state)
{
    (void)state;
    static const uint64_t counts[] = {1, 2, 3, 5, 64, 1000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        bool seen[1000] = {false};
        size_t moved = 0;
        for (uint64_t i = 0; i < counts[c]; i++) {
            uint64_t at = random_permute(0x123456789abcdef0, i, counts[c]);
            assert_true(at < counts[c] && !seen[at]);
            seen[at] = true;
            moved += at != i;
        }
        assert_true(counts[c] < 64 || moved > counts[c] / 2);
    }
}

/* Over many keys every element lands everywhere equally often: chi-squared with 7 degrees of
 * freedom is below 24.3 in all but one of a thousand cases. */
static void permutes_evenly(void **state)
{
    (void)state;
    enum { PLACES = 8, KEYS = 8000 };
    struct random_stream stream = {3, 9};
    unsigned counts[PLACES] = {0};
    for (uint64_t k = 0; k < KEYS; k++)
        counts[random_permute(random_bits(&stream, k, 0), 2, PLACES)]++;
    double sum = 0.0, expected = (double)KEYS / PLACES;
    for (int i = 0; i < PLACES; i++)
        sum += (counts[i] - expected) * (counts[i] - expected) / expected;
    assert_true(sum < 24.3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_philox),       cmocka_unit_test(depends_on_everything),
        cmocka_unit_test(is_uniform),      cmocka_unit_test(permutes),
        cmocka_unit_test(permutes_evenly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
