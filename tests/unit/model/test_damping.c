/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/damping.c: whose ratio is whose, and what a variation makes of them. */
#include "model/damping.h"

#include <string.h>

#include "check.h"

static void all_alike(void **state)
{
    (void)state;
    struct body body = {.damping = 0.01};
    struct body_description description = {.text = ""};
    assert_true(damping_of(&body, 0) == 0.01 && damping_of(&body, 4000) == 0.01);
    assert_true(damping_from(&body, 7) == 0.01);
    damping_describe(&body, &description);
    assert_non_null(strstr(description.text, "modal damping ratio 0.01"));
}

static void the_last_one_is_that_of_all_others(void **state)
{
    (void)state;
    double shares[] = {0.5, 1.0, 0.25};
    struct body body = {.damping = 0.04, .damping_shares = shares, .damping_count = 3};
    struct body_description description = {.text = ""};
    assert_true(damping_of(&body, 0) == 0.02 && damping_of(&body, 1) == 0.04);
    assert_true(damping_of(&body, 2) == 0.01 && damping_of(&body, 900) == 0.01);
    assert_true(damping_from(&body, 0) == 0.04 && damping_from(&body, 2) == 0.01);
    damping_describe(&body, &description);
    assert_non_null(strstr(description.text, "0.01 to 0.04 of the lowest 3 modes, 0.01 of"));
    /* who changes the body's damping scales all */
    body.damping = 0.08;
    assert_true(damping_of(&body, 0) == 0.04 && damping_of(&body, 5) == 0.02);
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
        assert_true(damping_of(&bodies[i], 1) == 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_alike),
        cmocka_unit_test(the_last_one_is_that_of_all_others),
        cmocka_unit_test(none_is_not_described),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
