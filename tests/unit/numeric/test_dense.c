/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/dense.c. */
#include "check.h"
#include "numeric/dense.h"

/* By hand; small whole numbers are exact. */
static void test_products_and_combinations(void **state)
{
    (void)state;
    static const double a[2][3] = {{1.0, 2.0, 3.0}, {0.0, 1.0, -1.0}};
    static const double b[1][3] = {{4.0, 5.0, 6.0}};
    double products[2], y[3] = {1.0, 1.0, 1.0};
    struct dense left = {3, 2, a[0]}, right = {3, 1, b[0]};
    dense_products(left, right, products);
    near(products[0], 32.0, 0.0);
    near(products[1], -1.0, 0.0);
    dense_combine(left, 2.0, (double[2]){1.0, 10.0}, 3.0, 1, y);
    near(y[0], 5.0, 0.0);
    near(y[1], 27.0, 0.0);
    near(y[2], -11.0, 0.0);
}

/* No vectors: nothing is touched. */
static void test_none(void **state)
{
    (void)state;
    double y[3] = {1.0, 2.0, 3.0};
    dense_combine((struct dense){3, 0, NULL}, 1.0, NULL, 0.5, 1, y);
    near(y[2], 3.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_products_and_combinations),
        cmocka_unit_test(test_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
