/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/solve/first_steps.c. */
#include "solve/attempt.h"
#include "solve/first_steps.h"
#include "unit/solve/search_lab.h"

/* A tenth of the tolerance; a hundredth of what a sequence amplifies tenfold, a thousandth in
 * groups and of the smallest tolerances; and never less than is tried. */
static void begins_below_the_tolerance(void **state)
{
    (void)state;
    near_relative(first_steps_accuracy(1e-3, false, false), 1e-4, 1e-12);
    near_relative(first_steps_accuracy(1e-3, true, false), 1e-5, 1e-12);
    near_relative(first_steps_accuracy(1e-4, true, false), 1e-7, 1e-12);
    near_relative(first_steps_accuracy(9e-5, true, false), 9e-7, 1e-12);
    near_relative(first_steps_accuracy(1e-4, true, true), 1e-7, 1e-12);
    near_relative(first_steps_accuracy(1e-8, false, false), 1e-11, 1e-12);
    near_relative(first_steps_accuracy(0.5, true, false), 1e-5, 1e-12);
    near_relative(first_steps_accuracy(0.5, true, true), 1e-6, 1e-12);
    near_relative(first_steps_accuracy(1e-17, false, false), ATTEMPT_FINEST, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(begins_below_the_tolerance)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
