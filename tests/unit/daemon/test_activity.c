/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/shared.c: what is read is what was set last, cut to fit. */
#include "check.h"
#include "daemon/shared.h"
#include "exchange/clock.h"

static void says_what_runs(void **state)
{
    (void)state;
    struct activity activity;
    char text[12];
    double progress;
    activity_create(&activity);
    activity_read(&activity, text, sizeof text, &progress);
    assert_string_equal(text, "");
    assert_true(isnan(progress));
    assert_true(isnan(activity_begun(&activity)));
    activity_set(&activity, text, 0.25, "%d of %d samples", 1, 4);
    activity_read(&activity, text, sizeof text, &progress);
    assert_string_equal(text, "1 of 4 samp");
    assert_true(progress == 0.25);
    /* what goes on has begun once */
    double begun = activity_begun(&activity);
    activity_set(&activity, text, 0.25, "%d of %d samples", 1, 4);
    assert_true(activity_begun(&activity) == begun && begun <= clock_now());
    /* another one is heard when this one has ended */
    activity_set(&activity, &progress, 0.5, "another");
    activity_clear(&activity, &progress);
    activity_read(&activity, text, sizeof text, &progress);
    assert_string_equal(text, "1 of 4 samp");
    activity_clear(&activity, text);
    activity_read(&activity, text, sizeof text, &progress);
    assert_string_equal(text, "");
    assert_true(isnan(progress));
    assert_true(isnan(activity_begun(&activity)));
    activity_release(&activity);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(says_what_runs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
