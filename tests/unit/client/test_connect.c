/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/lib/connect.c: whoever watches is asked while a server is looked for, and may give
 * it up. */
#include <percuss/percuss.h>

#include "check.h"
#include "domain.h"

enum { MOST_ASKED = 5 };

static bool look_on(void *context)
{
    unsigned *asked = context;
    return ++*asked < MOST_ASKED;
}

static void test_a_search_is_watched(void **state)
{
    struct percuss_client_config config = percuss_client_config_default();
    struct percuss_client *client;
    unsigned asked = 0;
    (void)state;
    config.domain = domain_draw();
    assert_int_equal(percuss_client_create(&config, &client), PERCUSS_RESULT_OK);
    percuss_client_watch(client, look_on, &asked);
    /* it would take a minute */
    assert_int_equal(percuss_client_connect(client, 60.0), PERCUSS_RESULT_CANCELLED);
    assert_int_equal(asked, MOST_ASKED);
    /* nobody looks on: to its end */
    percuss_client_watch(client, NULL, NULL);
    assert_int_equal(percuss_client_connect(client, 0.3), PERCUSS_RESULT_NO_SERVER);
    assert_int_equal(asked, MOST_ASKED);
    percuss_client_free(client);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_search_is_watched)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
