/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/cli/plot.c: an axis holds every number, whatever the numbers are. */
#include <stdlib.h>

#include "check.h"
#include "plot.h"

/* The axis that is set for the range. */
static void axis_of(const struct plot_range *range, double margin, double *low, double *high)
{
    char *text = NULL;
    size_t size = 0;
    struct plot plot = {.script = open_memstream(&text, &size)};
    plot_range_set(&plot, "yrange", range, margin);
    fclose(plot.script);
    assert_int_equal(sscanf(text, "set yrange [%lf:%lf]", low, high), 2);
    free(text);
}

static void holds_numbers_and_a_margin(void **state)
{
    (void)state;
    struct plot_range range = PLOT_NOTHING;
    const double values[] = {NAN, 70.0, 113.6, -6.4, INFINITY};
    double low, high;
    plot_range_take_all(&range, values, sizeof values / sizeof *values);
    assert_true(range.low == -6.4 && range.high == 113.6);
    /* width 120 */
    axis_of(&range, 0.05, &low, &high);
    assert_true(fabs(low + 12.4) < 1e-6 && fabs(high - 119.6) < 1e-6);
}

static void is_never_empty(void **state)
{
    (void)state;
    struct plot_range nothing = PLOT_NOTHING;
    const double values[] = {NAN, 0.0, 5e-7, -3.0, 1e9};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        double low, high;
        struct plot_range one = nothing;
        plot_range_take(&one, values[i]);
        axis_of(&one, 0.05, &low, &high);
        assert_true(low < high);
        assert_true(isnan(values[i]) || (low <= values[i] && values[i] <= high));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(holds_numbers_and_a_margin),
        cmocka_unit_test(is_never_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
