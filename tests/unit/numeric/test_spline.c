/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/spline.c: order, monotony, continuity, and the straight end. */
#include "check.h"
#include "numeric/spline.h"

enum { MOST = 65 };

struct sample {
    struct spline spline;
    double place[MOST], value[MOST], slope[MOST], scratch[2 * MOST];
};

static void make(struct sample *sample, size_t count, double (*function)(double))
{
    sample->spline = (struct spline){count, sample->place, sample->value, sample->slope};
    for (size_t i = 0; i < count; i++) {
        double x = (double)i / (double)(count - 1);
        sample->place[i] = x * (0.5 + 0.5 * x); /* uneven */
        sample->value[i] = function(sample->place[i]);
    }
    spline_set_slopes(&sample->spline, sample->scratch);
}

static double smooth(double x)
{
    return exp(2.0 * x) + x;
}

static double error_of(size_t count)
{
    static struct sample sample;
    double worst = 0.0;
    make(&sample, count, smooth);
    for (double x = 0.0; x <= 1.0; x += 1e-3) {
        double slope;
        worst = fmax(worst, fabs(spline_at(&sample.spline, x, &slope) - smooth(x)));
    }
    return worst;
}

static void the_error_falls_with_the_fourth_power(void **state)
{
    (void)state;
    double coarse = error_of(17), fine = error_of(33), finest = error_of(65);
    assert_true(fine < coarse / 12.0 && finest < fine / 12.0);
}

static double stairs(double x)
{
    return x < 0.4 ? 1e-3 * x : x < 0.6 ? 4e-4 + (x - 0.4) * 5.0 : 1.0004 + 1e-3 * (x - 0.6);
}

static void stairs_stay_monotone(void **state)
{
    (void)state;
    static struct sample sample;
    double before = -1.0;
    make(&sample, 12, stairs);
    for (double x = 0.0; x <= 1.2; x += 1e-4) {
        double slope;
        double value = spline_at(&sample.spline, x, &slope);
        assert_true(value >= before && slope >= 0.0);
        before = value;
    }
}

static void falling_values_work_as_well(void **state)
{
    (void)state;
    static struct sample sample;
    make(&sample, 20, stairs);
    for (size_t i = 0; i < 20; i++)
        sample.value[i] = -sample.value[i];
    spline_set_slopes(&sample.spline, sample.scratch);
    for (double x = 0.0; x <= 1.0; x += 1e-3) {
        double slope;
        spline_at(&sample.spline, x, &slope);
        assert_true(slope <= 0.0);
    }
}

static void slope_fits_value_and_ends_go_straight_on(void **state)
{
    (void)state;
    static struct sample sample;
    make(&sample, 17, smooth);
    for (double x = 0.01; x < 1.5; x += 0.0137) {
        double slope, ignored;
        spline_at(&sample.spline, x, &slope);
        double rate = (spline_at(&sample.spline, x + 1e-6, &ignored) -
                       spline_at(&sample.spline, x - 1e-6, &ignored)) /
                      2e-6;
        /* central differences; rounding over the step */
        assert_true(fabs(rate - slope) < 1e-7 * slope);
    }
    double first, last;
    spline_at(&sample.spline, 1.0, &first);
    spline_at(&sample.spline, 2.0, &last);
    assert_true(first == last);
    /* continuity at the places */
    for (size_t i = 1; i + 1 < 17; i++) {
        double left, right;
        double a = spline_on(&sample.spline, i - 1, sample.place[i], &left);
        double b = spline_on(&sample.spline, i, sample.place[i], &right);
        assert_true(fabs(a - b) < 1e-14 * b && fabs(left - right) < 1e-13 * left);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_error_falls_with_the_fourth_power),
        cmocka_unit_test(stairs_stay_monotone),
        cmocka_unit_test(falling_values_work_as_well),
        cmocka_unit_test(slope_fits_value_and_ends_go_straight_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
