/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/step_ends.c: begin and end of a contact on a straight line, and a
 * cubic that goes on. */
#include "check.h"
#include "impact/step_ends.h"

/* Indentations of slope * (s - zero) on the step. */
static struct step_values line(double nodes[NODES], double slope, double zero)
{
    for (int j = 0; j < NODES; j++)
        nodes[j] = slope * (collocation.node[j] - zero);
    return (struct step_values){-slope * zero, slope * (1.0 - zero), nodes};
}

static void lines_begin_and_end_where_they_are_zero(void **state)
{
    (void)state;
    double nodes[NODES];
    for (double zero = 0.01; zero < 1.0; zero += 0.0625) {
        struct step_values closes = line(nodes, 3.0, zero);
        near(step_values_closing(&closes), zero, 1e-15);
        struct step_values opens = line(nodes, -3.0, zero);
        near(step_values_release(&opens), zero, 1e-15);
    }
    struct step_values open = line(nodes, -1.0, -0.5);
    assert_true(step_values_closing(&open) == 1.0 && step_values_release(&open) == 0.0);
    struct step_values touches = line(nodes, 1.0, 0.0);
    assert_true(step_values_closing(&touches) == 0.0);
}

static void a_cubic_goes_on(void **state)
{
    (void)state;
    static const double c[4] = {2.0, -1.0, 0.5, 3.0}; /* of (t - h)^m */
    double h = 0.25, nodes[NODES];
    for (int j = 0; j < NODES; j++) {
        double x = (collocation.node[j] - 1.0) * h;
        nodes[j] = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
    }
    const struct step_values values = {0.0, 2.0, nodes};
    struct contact_start after = step_values_after(&values, h);
    near(after.indentation, c[0], 0.0);
    /* sums of terms up to 100 over h^m */
    near(after.rate, c[1], 1e-13 / h);
    near(after.curvature, 2.0 * c[2], 1e-13 / (h * h));
    near(after.bend, 6.0 * c[3], 1e-13 / (h * h * h));
}

/* d = 2 + v t - t^2 opens at the root of it; one that rises ever faster does not. */
static void a_parabola_opens(void **state)
{
    (void)state;
    for (double v = -1.0; v < 1.5; v += 0.5) {
        const struct contact_start now = {2.0, v, -2.0, 0.0};
        double t = step_values_opens(&now);
        near(2.0 + t * (v - t), 0.0, 1e-14);
    }
    const struct contact_start rising = {2.0, 1.0, 3.0, 0.0};
    assert_true(isinf(step_values_opens(&rising)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_begin_and_end_where_they_are_zero),
        cmocka_unit_test(a_cubic_goes_on),
        cmocka_unit_test(a_parabola_opens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
