/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/sampling.c: normal scores have the coefficients asked for. */
#include <string.h>

#include "check.h"
#include "ensemble/sampling.h"
#include "numeric/special.h"

static void correlates(void **state)
{
    (void)state;
    enum { N = 20000 };
    static const struct copula_pair pairs[] = {{0, 1, 0.8}, {1, 2, -0.5}};
    struct copula copula;
    struct fault fault;
    struct random_stream stream = {1, 0};
    double product[3] = {0.0, 0.0, 0.0}, mean = 0.0;
    assert_int_equal(copula_create(&copula, 3, pairs, 2, &fault), PERCUSS_OK);
    for (uint64_t i = 0; i < N; i++) {
        double u[3], z[3];
        for (int d = 0; d < 3; d++)
            u[d] = random_uniform(&stream, i, (uint64_t)d);
        copula_apply(&copula, u);
        for (int d = 0; d < 3; d++)
            z[d] = special_normal_quantile(u[d]);
        product[0] += z[0] * z[1];
        product[1] += z[1] * z[2];
        product[2] += z[0] * z[2];
        mean += u[2];
    }
    copula_release(&copula);
    /* a mean of N products has the deviation sqrt((1 + rho^2)/N) < 0.01; four of them */
    assert_true(fabs(product[0] / N - 0.8) < 0.04);
    assert_true(fabs(product[1] / N + 0.5) < 0.04);
    assert_true(fabs(product[2] / N) < 0.04);
    assert_true(fabs(mean / N - 0.5) < 0.01);
}

static void leaves_independent_points_alone(void **state)
{
    (void)state;
    struct copula copula;
    double u[2] = {0.3, 0.9};
    assert_int_equal(copula_create(&copula, 2, NULL, 0, NULL), PERCUSS_OK);
    copula_apply(&copula, u);
    assert_true(u[0] == 0.3 && u[1] == 0.9);
}

static void refuses_what_cannot_be(void **state)
{
    (void)state;
    static const struct copula_pair pairs[] = {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}};
    static const struct copula_pair whole = {0, 1, 1.0};
    struct copula copula;
    struct fault fault;
    assert_int_equal(copula_create(&copula, 3, pairs, 3, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "positive definite"));
    assert_int_equal(copula_create(&copula, 2, &whole, 1, &fault), PERCUSS_BAD_REQUEST);
    assert_non_null(strstr(fault.text, "correlations[0].coefficient: 1"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(correlates),
        cmocka_unit_test(leaves_independent_points_alone),
        cmocka_unit_test(refuses_what_cannot_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
