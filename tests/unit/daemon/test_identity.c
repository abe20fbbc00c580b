/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/identity.c: what the log says of an identity that ends, and how often. */
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "daemon/identity.h"

static const time_t END = 1764014400; /* 2025-11-24, 20:00 by UTC */
static const time_t DAY = 86400;

/* Of an identity that was read from a folder. */
static struct identity identity_until_end(void)
{
    return (struct identity){.folder = "keys",
                             .validity = {.begins = "cert.pem", .end = END, .ends = "cert.pem"},
                             .looked = -86400.0};
}

/* What a look puts on stderr, without its time. */
static const char *told(struct identity *identity, double now, time_t then)
{
    static char text[512];
    int ends[2], before = dup(STDERR_FILENO);
    assert_int_equal(pipe(ends), 0);
    dup2(ends[1], STDERR_FILENO);
    identity_look(identity, now, then);
    dup2(before, STDERR_FILENO);
    close(before);
    close(ends[1]);
    ssize_t size = read(ends[0], text, sizeof text - 1);
    close(ends[0]);
    assert_true(size >= 0);
    text[size] = '\0';
    return size > 0 ? strchr(text, ' ') + 1 : text;
}

static void it_is_told_once_a_day_from_thirty_days_before(void **state)
{
    (void)state;
    struct identity identity = identity_until_end();
    assert_string_equal(told(&identity, 0.0, END - 40 * DAY), "");
    assert_string_equal(told(&identity, 10.0 * 86400.0, END - 30 * DAY), "");
    assert_string_equal(told(&identity, 11.0 * 86400.0, END - 29 * DAY),
                        "warning security: keys/cert.pem: ends in 29 days, on 2025-11-24: make the "
                        "folder anew before, and restart\n");
    assert_string_equal(told(&identity, 11.9 * 86400.0, END - 28 * DAY), "");
    assert_non_null(strstr(told(&identity, 12.0 * 86400.0, END - 28 * DAY), "ends in 28 days"));
}

static void an_end_is_told_at_once_as_an_error(void **state)
{
    (void)state;
    struct identity identity = identity_until_end();
    assert_non_null(strstr(told(&identity, 0.0, END), "ends in less than a day"));
    assert_non_null(strstr(told(&identity, 1.0, END + 1), "ended less than a day ago"));
    assert_string_equal(told(&identity, 2.0, END + 2), "");
    identity = identity_until_end();
    assert_string_equal(told(&identity, 0.0, END + 2 * DAY),
                        "error   security: keys/cert.pem: ended 2 days ago, on 2025-11-24: clients "
                        "that come now do not believe it\n");
    assert_string_equal(told(&identity, 1.0, END + 2 * DAY), "");
}

static void who_is_not_secured_has_none(void **state)
{
    (void)state;
    struct identity identity;
    identity_read(&identity, NULL);
    assert_string_equal(told(&identity, 0.0, END), "");
    identity_read(&identity, "/none");
    assert_string_equal(told(&identity, 0.0, END), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_told_once_a_day_from_thirty_days_before),
        cmocka_unit_test(an_end_is_told_at_once_as_an_error),
        cmocka_unit_test(who_is_not_secured_has_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
