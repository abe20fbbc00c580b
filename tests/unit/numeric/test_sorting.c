/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/sorting.c: the order that comparisons give. */
#include "numeric/sorting.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "numeric/random_stream.h"

enum { N = 3000 };

static double value_of(uint64_t i)
{
    static const double rare[] = {-INFINITY, -DBL_MAX, -0x1p-1074, 0.0, 0x1p-1074, DBL_MAX, INFINITY};
    static const struct random_stream stream = {5, 0};
    double u = random_uniform(&stream, i, 0), size = 600.0 * random_uniform(&stream, i, 1);
    if (i % 10 == 0)
        return rare[random_bits(&stream, i, 2) % (sizeof rare / sizeof *rare)];
    return i % 3 ? (u < 0.5 ? -1.0 : 1.0) * pow(10.0, size - 300.0) : floor(20.0 * u);
}

/* Of all sizes and both signs, many of them equal: these in the order they had. */
static void ascends_and_keeps_the_order_of_equals(void **state)
{
    (void)state;
    static double before[N], values[N];
    static size_t origin[N];
    for (size_t i = 0; i < N; i++) {
        before[i] = values[i] = value_of(i);
        origin[i] = i;
    }
    assert_true(sorting_ascend(values, origin, N));
    size_t equals = 0, seen[N] = {0};
    for (size_t i = 0; i < N; i++) {
        assert_true(values[i] == before[origin[i]]);
        assert_int_equal(seen[origin[i]]++, 0);
        assert_true(i == 0 || values[i - 1] <= values[i]);
        bool equal = i > 0 && values[i - 1] == values[i];
        assert_true(!equal || origin[i - 1] < origin[i]);
        equals += equal;
    }
    assert_true(equals > N / 4);
    /* the numbers alone */
    assert_true(sorting_ascend(before, NULL, N));
    assert_memory_equal(before, values, sizeof values);
}

static void zeros_are_equal(void **state)
{
    (void)state;
    double values[] = {0.0, -0.0, -1.0};
    size_t origin[] = {7, 8, 9};
    const size_t expected[] = {9, 7, 8};
    assert_true(sorting_ascend(values, origin, 3));
    assert_memory_equal(origin, expected, sizeof expected);
    assert_false(signbit(values[2]));
    assert_true(sorting_ascend(values, origin, 0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascends_and_keeps_the_order_of_equals),
        cmocka_unit_test(zeros_are_equal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
