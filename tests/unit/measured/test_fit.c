/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/measured/fit.c: a line with its textbook intervals, a curve whose intervals cover
 * the truth as often as they say, and parameters that the data do not determine. */
#include <string.h>

#include "check.h"
#include "fit.h"
#include "random.h"

enum { POINTS = 40 };

struct data {
    double x[POINTS], y[POINTS];
};

static bool line(void *context, const double *p, double *residuals)
{
    const struct data *data = context;
    for (int i = 0; i < POINTS; i++)
        residuals[i] = p[0] + p[1] * data->x[i] - data->y[i];
    return true;
}

/* Slope and intercept by the formulas for a straight line. */
static void a_line_has_its_textbook_intervals(void **state)
{
    (void)state;
    struct data data;
    struct random random = {3};
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (int i = 0; i < POINTS; i++) {
        double x = data.x[i] = 0.1 * i,
               y = data.y[i] = 1.5 + 0.7 * x + 0.05 * random_normal(&random);
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    double mean = sx / POINTS, spread = sxx - POINTS * mean * mean;
    double slope = (sxy - mean * sy) / spread, intercept = sy / POINTS - slope * mean, sum = 0.0;
    for (int i = 0; i < POINTS; i++)
        sum += pow(intercept + slope * data.x[i] - data.y[i], 2.0);
    double sigma = sqrt(sum / (POINTS - 2));
    struct fit_problem problem = {2, POINTS, line, &data, 1e-4, NULL, 0};
    struct fit fit = {.x = {1.0, 1.0}};
    assert_true(fit_solve(&problem, &fit));
    near_relative(fit.x[0], intercept, 1e-6);
    near_relative(fit.x[1], slope, 1e-6);
    near_relative(fit.deviation[1], sigma / sqrt(spread), 1e-6);
    near_relative(fit.deviation[0], sigma * sqrt(1.0 / POINTS + mean * mean / spread), 1e-6);
    near_relative(fit.correlation[0][1], -mean / sqrt(sxx / POINTS), 1e-6);
    near_relative(fit.half_width[1] / fit.deviation[1], 2.0243941644, 1e-6); /* t.ppf(0.975, 38) */
    near_relative(fit.sum, sum, 1e-6);
    assert_true(fit.freedom == POINTS - 2);
}

static bool decay(void *context, const double *p, double *residuals)
{
    const struct data *data = context;
    for (int i = 0; i < POINTS; i++)
        residuals[i] = (p[0] * exp(-p[1] * data->x[i]) - data->y[i]) / 0.02;
    return true;
}

/* 400 repeated measurements: 95 % intervals cover the truth in 95 % +- 1.1 %. */
static void intervals_cover_the_truth(void **state)
{
    (void)state;
    struct random random = {17};
    int covered[2] = {0, 0};
    for (int trial = 0; trial < 400; trial++) {
        struct data data;
        const double truth[2] = {1.2, 0.9};
        for (int i = 0; i < POINTS; i++) {
            data.x[i] = 0.1 * i;
            data.y[i] = truth[0] * exp(-truth[1] * data.x[i]) + 0.02 * random_normal(&random);
        }
        struct fit_problem problem = {2, POINTS, decay, &data, 1e-4, NULL, 0};
        struct fit fit = {.x = {1.0, 1.0}};
        assert_true(fit_solve(&problem, &fit));
        for (int k = 0; k < 2; k++)
            covered[k] += fabs(fit.x[k] - truth[k]) <= fit.half_width[k];
    }
    for (int k = 0; k < 2; k++)
        assert_in_range(covered[k], 367, 393);
}

/* Readings in fives that share most of their error: as independent ones they promise too much. */
static void groups_that_share_errors_widen_intervals(void **state)
{
    (void)state;
    struct random random = {29};
    int covered = 0, covered_alone = 0;
    size_t group[POINTS];
    for (int trial = 0; trial < 400; trial++) {
        struct data data;
        double shared = 0.0;
        for (int i = 0; i < POINTS; i++) {
            if (i % 2 == 0)
                shared = 0.02 * random_normal(&random);
            group[i] = (size_t)i / 2;
            data.x[i] = 0.1 * i;
            data.y[i] = 1.5 + 0.7 * data.x[i] + shared + 0.004 * random_normal(&random);
        }
        struct fit_problem problem = {2, POINTS, line, &data, 1e-4, NULL, 0};
        struct fit fit = {.x = {1.0, 1.0}};
        assert_true(fit_solve(&problem, &fit));
        covered_alone += fabs(fit.x[1] - 0.7) <= fit.half_width[1];
        problem.group = group;
        problem.groups = POINTS / 2;
        assert_true(fit_solve(&problem, &fit));
        covered += fabs(fit.x[1] - 0.7) <= fit.half_width[1];
    }
    /* 380 expected; sandwich intervals of 20 groups fall some per cent short */
    assert_in_range(covered, 356, 394);
    assert_true(covered_alone < 345);
}

/* Only the sum of the first two matters, and the third not at all. */
static bool degenerate(void *context, const double *p, double *residuals)
{
    const struct data *data = context;
    for (int i = 0; i < POINTS; i++)
        residuals[i] = (p[0] + p[1]) * data->x[i] - data->y[i] + 0.0 * p[2];
    return true;
}

static void what_is_not_determined_is_told(void **state)
{
    (void)state;
    struct data data;
    struct random random = {23};
    for (int i = 0; i < POINTS; i++) {
        data.x[i] = 0.1 * i;
        data.y[i] = 3.0 * data.x[i] + 0.01 * random_normal(&random);
    }
    struct fit_problem problem = {3, POINTS, degenerate, &data, 1e-4, NULL, 0};
    struct fit fit = {.x = {1.0, 1.0, 1.0}};
    assert_true(fit_solve(&problem, &fit));
    near_relative(fit.x[0] + fit.x[1], 3.0, 1e-2);
    assert_true(isinf(fit.deviation[0]) || isinf(fit.deviation[1]));
    assert_true(isinf(fit.deviation[2]) && isinf(fit.half_width[2]));
    problem.residuals = 3;
    assert_false(fit_solve(&problem, &fit));
}

static bool failing(void *context, const double *p, double *residuals)
{
    (void)context, (void)p, (void)residuals;
    return false;
}

static void a_failure_stops_it(void **state)
{
    (void)state;
    struct fit_problem problem = {1, 5, failing, NULL, 1e-4, NULL, 0};
    struct fit fit = {.x = {1.0}};
    assert_false(fit_solve(&problem, &fit));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_has_its_textbook_intervals),
        cmocka_unit_test(intervals_cover_the_truth),
        cmocka_unit_test(groups_that_share_errors_widen_intervals),
        cmocka_unit_test(what_is_not_determined_is_told),
        cmocka_unit_test(a_failure_stops_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
