/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/flight_kernel.c: made once, for all modes of a set, and theirs only.
 */
#include "impact/flight_kernel.h"

#include "check.h"
#include "impact/oscillator.h"

enum { COUNT = 6, LEVEL = 9 };

static void is_made_once_and_exact(void **state)
{
    (void)state;
    static const double omega[COUNT] = {10.0, 30.0, 100.0, 300.0, 1e3, 3e3};
    static const double damping[COUNT] = {0.0, 0.01, 0.02, 0.05, 0.1, 0.2};
    struct oscillators *set = oscillators_create_each(COUNT, omega, damping);
    assert_non_null(set);
    const double *table = flight_table(set, LEVEL);
    assert_non_null(table);
    assert_true(flight_table(set, LEVEL) == table);
    assert_true(flight_table(set, LEVEL + 1) != table);
    /* a mode at a time */
    for (size_t k = 0; k < COUNT; k++) {
        _Alignas(32) double q[2 * LANES] = {0.0}, v[2 * LANES] = {0.0};
        struct flight_modes modes = {.length = set->stride, .q = q, .v = v};
        double expected[2] = {1.0, 2.0 * omega[k]};
        q[k] = expected[0];
        v[k] = expected[1];
        flight_kernel_step(table, &modes, q, v);
        oscillator_advance(omega[k], damping[k], step_length(LEVEL), &expected[0], &expected[1]);
        /* a few roundings of an amplitude of some 2 */
        near(q[k], expected[0], 2e-15);
        near(v[k], expected[1], 2e-15 * omega[k]);
        for (size_t j = 0; j < set->stride; j++)
            assert_true(j == k || (q[j] == 0.0 && v[j] == 0.0));
    }
    oscillators_free(set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_made_once_and_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
