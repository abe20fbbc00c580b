/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/ensemble/spec.c: quantile functions against closed forms, and refusals. */
#include <string.h>

#include "check.h"
#include "ensemble/spec.h"
#include "numeric/special.h"

static struct ensemble_input make(enum input_quantity quantity, enum distribution distribution,
                                  double first, double second)
{
    return (struct ensemble_input){.quantity = quantity,
                                   .distribution = distribution,
                                   .first = first,
                                   .second = second,
                                   .lower = NAN,
                                   .upper = NAN};
}

/* Mean and deviation by the midpoint rule in probability. */
static void moments(const struct ensemble_input *input, double *mean, double *deviation)
{
    enum { N = 200000 };
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < N; i++) {
        double value = input_value(input, (i + 0.5) / N);
        sum += value;
        squares += value * value;
    }
    *mean = sum / N;
    *deviation = sqrt(squares / N - *mean * *mean);
}

static void uniform_and_constant(void **state)
{
    (void)state;
    double mean, deviation;
    struct ensemble_input input = make(INPUT_SPEED, DISTRIBUTION_IS_UNIFORM, 0.089, 0.411);
    moments(&input, &mean, &deviation);
    near(mean, 0.25, 1e-12);
    near(deviation, 0.322 / sqrt(12.0), 1e-9);
    input = make(INPUT_SPEED, DISTRIBUTION_IS_CONSTANT, 0.3, NAN);
    near(input_value(&input, 0.77), 0.3, 0.0);
}

/* Far from its bounds nothing is cut off. */
static void normal(void **state)
{
    (void)state;
    double mean, deviation;
    struct ensemble_input input = make(INPUT_YOUNG, DISTRIBUTION_IS_NORMAL, 70e9, 1e9);
    moments(&input, &mean, &deviation);
    near(mean / 70e9, 1.0, 1e-9);
    near(deviation / 1e9, 1.0, 1e-4); /* the tails beyond 1/N */
    near(input_value(&input, 0.975), 70e9 + 1e9 * 1.9599639845400545, 1.0);
    near(input_truncated(&input), 0.0, 1e-15);
}

/* Truncated at a and b: mean m + s (phi(a) - phi(b))/Z, and its variance (Johnson, Kotz and
 * Balakrishnan, Continuous Univariate Distributions 1, 13.10.1). */
static void truncated_normal(void **state)
{
    (void)state;
    double mean, deviation;
    struct ensemble_input input = make(INPUT_SPEED, DISTRIBUTION_IS_NORMAL, 0.25, 0.2);
    input.lower = 0.1;
    input.upper = 0.9;
    double a = -0.75, b = 3.25, root = sqrt(2.0 * M_PI);
    double pa = exp(-0.5 * a * a) / root, pb = exp(-0.5 * b * b) / root;
    double z = special_normal_cdf(b) - special_normal_cdf(a), shift = (pa - pb) / z;
    moments(&input, &mean, &deviation);
    near(mean, 0.25 + 0.2 * shift, 1e-8);
    near(deviation, 0.2 * sqrt(1.0 + (a * pa - b * pb) / z - shift * shift), 1e-6);
    near(input_truncated(&input), 1.0 - z, 1e-15);
    near(input_value(&input, 1e-15), 0.1, 1e-12);
    near(input_value(&input, 1.0 - 1e-15), 0.9, 1e-9);
}

/* The far tail keeps its digits: above 8 deviations the values still spread. */
static void tail_of_a_normal(void **state)
{
    (void)state;
    struct ensemble_input input = make(INPUT_SPEED, DISTRIBUTION_IS_NORMAL, 1.0, 0.1);
    input.lower = 1.4;
    double before = 1.4;
    for (double u = 0.05; u < 1.0; u += 0.05) {
        double value = input_value(&input, u);
        assert_true(value > before);
        /* P(Z > z) = (1 - u) P(Z > 4) */
        near(special_normal_cdf(-(value - 1.0) / 0.1) / special_normal_cdf(-4.0), 1.0 - u, 1e-12);
        before = value;
    }
}

/* Physics truncates too: a speed is positive. */
static void speed_is_positive(void **state)
{
    (void)state;
    struct ensemble_input input = make(INPUT_SPEED, DISTRIBUTION_IS_NORMAL, 0.1, 0.1);
    assert_true(input_value(&input, 1e-9) > 0.0);
    near(input_truncated(&input), special_normal_cdf(-1.0), 1e-5);
}

static void log_normal(void **state)
{
    (void)state;
    double mean, deviation;
    struct ensemble_input input = make(INPUT_DENSITY, DISTRIBUTION_IS_LOG_NORMAL, 2700.0, 300.0);
    moments(&input, &mean, &deviation);
    near(mean / 2700.0, 1.0, 1e-6);
    near(deviation / 300.0, 1.0, 1e-3);
    double s2 = log1p(1.0 / 81.0);
    near(input_value(&input, 0.5) / (2700.0 * exp(-0.5 * s2)), 1.0, 1e-12);
}

static void list(void **state)
{
    (void)state;
    static const double values[] = {0.3, 0.1, 0.2};
    struct ensemble_input input = make(INPUT_SPEED, DISTRIBUTION_IS_LIST, NAN, NAN);
    input.values = values;
    input.value_count = 3;
    near(input_value(&input, 0.1), 0.3, 0.0);
    near(input_value(&input, 0.5), 0.1, 0.0);
    near(input_value(&input, 0.99999), 0.2, 0.0);
}

static void refuses(struct ensemble_input input, const char *words)
{
    struct fault fault = {""};
    assert_int_equal(input_check(&input, 3, &fault), PERCUSS_BAD_REQUEST);
    if (!strstr(fault.text, words) || !strstr(fault.text, "inputs[3]."))
        fail_msg("'%s' does not say '%s'", fault.text, words);
}

static void refusals(void **state)
{
    (void)state;
    static const double values[] = {0.3, -0.1};
    refuses(make(INPUT_SPEED, DISTRIBUTION_IS_CONSTANT, -1.0, 0.0), "first: -1");
    refuses(make(INPUT_SPEED, DISTRIBUTION_IS_CONSTANT, NAN, 0.0), "first");
    refuses(make(INPUT_SPEED, DISTRIBUTION_IS_UNIFORM, 0.4, 0.1), "at least first");
    refuses(make(INPUT_SITE, DISTRIBUTION_IS_UNIFORM, 0.4, 1.1), "second: 1.1");
    refuses(make(INPUT_YOUNG, DISTRIBUTION_IS_NORMAL, 70e9, -1.0), "second: -1");
    refuses(make(INPUT_YOUNG, DISTRIBUTION_IS_NORMAL, NAN, 1.0), "finite mean");
    refuses(make(INPUT_YOUNG, DISTRIBUTION_IS_LOG_NORMAL, -2.0, 1.0), "mean > 0");
    refuses(make(INPUT_DAMPING, DISTRIBUTION_IS_NORMAL, -5.0, 0.1), "must be a ratio >= 0 and < 1");
    refuses(make(INPUT_YOUNG, DISTRIBUTION_IS_NORMAL, 70.0, 1.0),
            "first: 70 Pa: must be a finite modulus > 0 Pa (1e3 to 1e13 Pa), such as 70 GPa "
            "(young, normal)");
    refuses(make(INPUT_RADIUS, DISTRIBUTION_IS_UNIFORM, 1e4, 2e4), "first: 10000 m: must be");
    refuses(make(INPUT_POISSON, DISTRIBUTION_IS_NORMAL, 0.6, 0.0), "first: 0.6");
    struct ensemble_input input = make(INPUT_SPEED, DISTRIBUTION_IS_NORMAL, 0.2, 0.1);
    input.lower = 0.3;
    input.upper = 0.2;
    refuses(input, "above lower");
    input = make(INPUT_YOUNG, DISTRIBUTION_IS_NORMAL, 70e9, 1e9);
    input.lower = 1e9;
    input.upper = 2e9;
    refuses(input, "first: 7e+10 Pa: must be such that the distribution lies within its truncation "
                   "and within what the quantity can be, 1e+09 to 2e+09 Pa (young, normal)");
    input = make(INPUT_SPEED, DISTRIBUTION_IS_LIST, 0.0, 0.0);
    refuses(input, "none given");
    input.values = values;
    input.value_count = 2;
    refuses(input, "values[1]: -0.1");
}

static void names(void **state)
{
    (void)state;
    for (unsigned i = 0; i < INPUT_QUANTITY_COUNT; i++)
        assert_int_equal(input_quantity_find(input_quantity_name(i)), i);
    assert_int_equal(input_quantity_find("mass"), INPUT_QUANTITY_COUNT);
    assert_int_equal(input_quantity_find("at"), INPUT_SITE);
    assert_true(input_is_of_model(input_quantity_find("model-yield")));
    assert_true(!input_is_of_body(INPUT_MODEL_FORCE) && !input_is_of_body(INPUT_MODEL_YIELD));
    assert_true(input_is_of_body(INPUT_SITE) && !input_is_of_model(INPUT_SITE));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uniform_and_constant),
        cmocka_unit_test(normal),
        cmocka_unit_test(truncated_normal),
        cmocka_unit_test(tail_of_a_normal),
        cmocka_unit_test(speed_is_positive),
        cmocka_unit_test(log_normal),
        cmocka_unit_test(list),
        cmocka_unit_test(refusals),
        cmocka_unit_test(names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
