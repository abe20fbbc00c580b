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

static struct indices_point *points_of(double (*f)(const double x[3]), int dimension, size_t count)
{
    struct indices_point *points = malloc(count * sizeof *points);
    double *x = malloc(count * sizeof *x), *y = malloc(count * sizeof *y);
    for (uint64_t i = 0; i < count; i++) {
        const double all[3] = {u(i, 0), u(i, 1), u(i, 2)};
        x[i] = all[dimension];
        y[i] = f(all);
    }
    size_t kept;
    assert_true(indices_sort(x, y, count, points, &kept));
    assert_int_equal(kept, count);
    free(x);
    free(y);
    return points;
}

static void missing_values_are_left_out(void **state)
{
    (void)state;
    const double x[] = {NAN, 2.0, 3.0}, y[] = {1.0, NAN, 4.0};
    struct indices_point sorted[3];
    size_t kept;
    assert_true(indices_sort(x, y, 3, sorted, &kept));
    assert_int_equal(kept, 1);
    assert_true(sorted[0].x == 3.0 && sorted[0].y == 4.0 && sorted[0].sample == 2);
}

/* Smooth below 1/2, and white noise above. */
static double half_rough(const double x[3])
{
    return x[0] < 0.5 ? x[0] : x[1];
}

static void tells_smooth_from_rough(void **state)
{
    (void)state;
    struct indices_point *points = points_of(half_rough, 0, N);
    struct influence_part parts[10];
    influence_parts(points, N, 0.01, parts, 10);
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
    free(points);
}

static double list_value(uint64_t i)
{
    return floor(60.0 * u(i, 0)) / 59.0;
}

/* Neighbours in a list of values are a resolution and a half apart: white noise has its deviation
 * between them in every part, as y does not decide which samples are compared. Of some N/10 pairs
 * in a part, each with a square of 1/6 +- 0.2, four deviations. */
static void equal_values_are_in_an_order_by_chance(void **state)
{
    (void)state;
    double *x = malloc(N * sizeof *x), *y = malloc(N * sizeof *y);
    struct indices_point *points = malloc(N * sizeof *points);
    struct influence_part parts[10];
    size_t kept;
    for (uint64_t i = 0; i < N; i++) {
        x[i] = list_value(i);
        y[i] = u(i, 1);
    }
    assert_true(indices_sort(x, y, N, points, &kept));
    influence_parts(points, N, 0.01, parts, 10);
    for (int k = 0; k < 10; k++)
        near(parts[k].local * parts[k].local, 1.0 / 12.0, 4.0 * 0.1 / sqrt(N / 10.0));
    free(x);
    free(y);
    free(points);
}

static void sparse_parts_are_unknown(void **state)
{
    (void)state;
    struct indices_point points[4] = {{0.0, 1.0, 0}, {1.0, 2.0, 1}, {2.0, 3.0, 2}, {3.0, 4.0, 3}};
    struct influence_part parts[6];
    influence_parts(points, 4, 0.03, parts, 6);
    assert_true(isnan(parts[0].local) && !parts[0].chaotic);
    assert_true(isnan(parts[1].mean) && parts[1].count == 0);
    assert_int_equal(parts[5].count, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_values_are_left_out),
        cmocka_unit_test(tells_smooth_from_rough),
        cmocka_unit_test(equal_values_are_in_an_order_by_chance),
        cmocka_unit_test(sparse_parts_are_unknown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
