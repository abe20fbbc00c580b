/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/oscillator.c: against the maps by moments, which take another way,
 * at every angle that the series reach, and against exact integrals. */
#include "check.h"
#include "impact/oscillator.h"

static void responses_are_the_maps(void **state)
{
    (void)state;
    const double h = 0x1p-14;
    for (double angle = 1e-9; oscillator_series_reaches(angle); angle *= 1.07) {
        double by[SERIES_ROWS][NODES];
        oscillator_series_response(angle, h, by);
        for (int row = 0; row < STEP_POINTS; row++) {
            double c = row < NODES ? collocation.node[row] : 1.0;
            double to_q[NODES + 2], to_v[NODES + 2];
            oscillator_map(angle / h, 0.0, h, c, to_q, to_v);
            for (int j = 0; j < NODES; j++)
                /* Lagrange's monomials of up to 31 cancel in the maps */
                measured("q", by[row][j], to_q[2 + j], 2e-15 * h * h);
            for (int j = 0; row == NODES && j < NODES; j++)
                measured("v", by[STEP_POINTS][j], to_v[2 + j], 4e-15 * h);
        }
    }
}

/* Forces of one at all nodes are a constant one: (1 - cos omega t)/omega^2, and sin(omega t)/omega.
 * By the half angle, which does not cancel. */
static void a_constant_force_is_exact(void **state)
{
    (void)state;
    for (double angle = 1e-6; oscillator_series_reaches(angle); angle *= 1.03) {
        double by[SERIES_ROWS][NODES];
        oscillator_series_response(angle, 1.0, by);
        for (int row = 0; row < SERIES_ROWS; row++) {
            double sum = (by[row][0] + by[row][3]) + (by[row][1] + by[row][2]);
            double c = row < NODES ? collocation.node[row] : 1.0;
            double half = sin(0.5 * angle * c) / angle;
            double expected = row < STEP_POINTS ? 2.0 * half * half : sin(angle) / angle;
            /* roundings of three sums of up to one and of what is added, of the sine and quotient
             */
            measured("sum", sum, expected, 5e-16);
        }
    }
    assert_false(oscillator_series_reaches(3.0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(responses_are_the_maps),
        cmocka_unit_test(a_constant_force_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
