/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/indices.c: where a function is rough. */
#include <string.h>

#include "check.h"
#include "ensemble/indices.h"
#include "numeric/random_stream.h"

enum { N = 20000 };
static const struct random_stream stream = {11, 0};

static double u(uint64_t i, int d)
{
    return random_uniform(&stream, i, (uint64_t)d);
}

static struct influence_pair *pairs_of(double (*f)(const double x[3]), int dimension, size_t count)
{
    struct influence_pair *pairs = malloc(count * sizeof *pairs);
    for (uint64_t i = 0; i < count; i++) {
        const double x[3] = {u(i, 0), u(i, 1), u(i, 2)};
        pairs[i] = (struct influence_pair){x[dimension], f(x)};
    }
    assert_int_equal(influence_sort(pairs, count), count);
    return pairs;
}

static void missing_values_are_left_out(void **state)
{
    (void)state;
    struct influence_pair missing[3] = {{NAN, 1.0}, {2.0, NAN}, {3.0, 4.0}};
    assert_int_equal(influence_sort(missing, 3), 1);
    assert_true(missing[0].x == 3.0);
}

/* Smooth below 1/2, and white noise above. */
static double half_rough(const double x[3])
{
    return x[0] < 0.5 ? x[0] : x[1];
}

static void tells_smooth_from_rough(void **state)
{
    (void)state;
    struct influence_pair *pairs = pairs_of(half_rough, 0, N);
    struct influence_part parts[10];
    influence_parts(pairs, N, 0.01, parts, 10);
    size_t count = 0;
    for (int k = 0; k < 10; k++) {
        count += parts[k].count;
        assert_true(parts[k].chaotic == (k >= 5));
        if (k < 4) /* a difference of 0.01 to 0.02, over sqrt 2 */
            assert_true(parts[k].local > 0.006 && parts[k].local < 0.015);
        if (k >= 5) /* white noise's deviation */
            assert_true(fabs(parts[k].local - sqrt(1.0 / 12.0)) < 0.02);
        assert_true(fabs(parts[k].high - parts[k].low - 0.1) < 1e-3);
    }
    assert_int_equal(count, N);
    free(pairs);
}

static void sparse_parts_are_unknown(void **state)
{
    (void)state;
    struct influence_pair pairs[4] = {{0.0, 1.0}, {1.0, 2.0}, {2.0, 3.0}, {3.0, 4.0}};
    struct influence_part parts[6];
    influence_parts(pairs, 4, 0.03, parts, 6);
    assert_true(isnan(parts[0].local) && !parts[0].chaotic);
    assert_true(isnan(parts[1].mean) && parts[1].count == 0);
    assert_int_equal(parts[5].count, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_values_are_left_out),
        cmocka_unit_test(tells_smooth_from_rough),
        cmocka_unit_test(sparse_parts_are_unknown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
