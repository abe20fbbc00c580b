/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/damping.c: whose ratio is whose, and what a variation makes of them.
 */
#include "model/damping.h"

#include <string.h>

#include "check.h"

static void all_alike(void **state)
{
    (void)state;
    struct body body = {.damping = 0.01};
    struct body_description description = {.text = ""};
    assert_true(damping_of(&body, 0, 1.0) == 0.01 && damping_of(&body, 4000, 1.0) == 0.01);
    assert_true(damping_from(&body, 7, 1.0) == 0.01);
    damping_describe(&body, &description);
    assert_non_null(strstr(description.text, "modal damping ratio 0.01"));
}

static void the_last_one_is_that_of_all_others(void **state)
{
    (void)state;
    double shares[] = {0.5, 1.0, 0.25};
    struct body body = {.damping = 0.04, .damping_shares = shares, .damping_count = 3};
    struct body_description description = {.text = ""};
    assert_true(damping_of(&body, 0, 1.0) == 0.02 && damping_of(&body, 1, 1.0) == 0.04);
    assert_true(damping_of(&body, 2, 1.0) == 0.01 && damping_of(&body, 900, 1.0) == 0.01);
    assert_true(damping_from(&body, 0, 1.0) == 0.04 && damping_from(&body, 2, 1.0) == 0.01);
    damping_describe(&body, &description);
    assert_non_null(strstr(description.text, "0.01 to 0.04 of the lowest 3 modes, 0.01 of"));
    /* who changes the body's damping scales all */
    body.damping = 0.08;
    assert_true(damping_of(&body, 0, 1.0) == 0.04 && damping_of(&body, 5, 1.0) == 0.02);
}

/* Half of the loss factor at each mode's own frequency, and in an estimate of all from one on the
 * largest. */
static void a_material_that_relaxes_damps_by_frequency(void **state)
{
    (void)state;
    struct body body = {.relaxation = {1, {0.19}, {1e-3}}};
    double peak = 0.19 / (2.0 * 0.9), top = 900.0; /* sqrt(1 - share)/time */
    body.damping_peak = relaxation_peak_loss(&body.relaxation, 0.0);
    body.damping = 0.5 * body.damping_peak;
    near_relative(damping_of(&body, 0, top), 0.5 * peak, 1e-12);
    for (double omega = 1.0; omega < 1e6; omega *= 10.0)
        near_relative(damping_of(&body, 3, omega),
                      0.5 * relaxation_loss_factor(&body.relaxation, omega), 1e-12);
    near_relative(damping_from(&body, 0, 1.0), 0.5 * peak, 0.01);
    near_relative(damping_from(&body, 5, 1e5), damping_of(&body, 5, 1e5), 1e-12);
    struct body_description description = {.text = ""};
    damping_describe(&body, &description);
    assert_non_null(strstr(description.text, "damping ratios by its relaxation, 0.0525 at most"));
    /* who changes the body's damping scales all */
    body.damping *= 2.0;
    near_relative(damping_of(&body, 0, top), peak, 1e-12);
}

static void none_is_not_described(void **state)
{
    (void)state;
    double shares[] = {0.0, 0.0};
    struct body bodies[] = {{.damping = 0.0}, {.damping_shares = shares, .damping_count = 2}};
    for (int i = 0; i < 2; i++) {
        struct body_description description = {.text = ""};
        damping_describe(&bodies[i], &description);
        assert_string_equal(description.text, "");
        assert_true(damping_of(&bodies[i], 1, 1.0) == 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_alike),
        cmocka_unit_test(the_last_one_is_that_of_all_others),
        cmocka_unit_test(a_material_that_relaxes_damps_by_frequency),
        cmocka_unit_test(none_is_not_described),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
