/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/percuss.h>
#include <string.h>

#include "check.h"
#include "domain.h"
#include "wire.h"

enum { MOST = 8 };

/* Clients of a process and a domain have one participant, and the last one takes it along. */
static void test_one_a_domain(void **state)
{
    (void)state;
    struct percuss_client_config config = percuss_client_config_default();
    dds_entity_t found[MOST];
    config.domain = domain_draw();
    for (int round = 0; round < 3; round++) {
        struct percuss_client *first, *second;
        assert_int_equal(percuss_client_create(&config, &first), PERCUSS_RESULT_OK);
        assert_int_equal(percuss_client_create(&config, &second), PERCUSS_RESULT_OK);
        assert_int_equal(dds_lookup_participant(config.domain, found, MOST), 1);
        percuss_client_free(first);
        assert_int_equal(dds_lookup_participant(config.domain, found, MOST), 1);
        percuss_client_free(second);
        assert_int_equal(dds_lookup_participant(config.domain, found, MOST), 0);
    }
}

/* A client leaves nothing behind in a participant that others still use: neither endpoints nor
 * topics. */
static void test_nothing_stays(void **state)
{
    (void)state;
    struct percuss_client_config config = percuss_client_config_default();
    struct percuss_client *keeper, *passing;
    dds_entity_t participant, before[MOST];
    config.domain = domain_draw();
    assert_int_equal(percuss_client_create(&config, &keeper), PERCUSS_RESULT_OK);
    assert_int_equal(dds_lookup_participant(config.domain, &participant, 1), 1);
    int children = dds_get_children(participant, before, MOST);
    assert_int_equal(percuss_client_create(&config, &passing), PERCUSS_RESULT_OK);
    assert_true(dds_get_children(participant, before, MOST) > children);
    percuss_client_free(passing);
    assert_int_equal(dds_get_children(participant, before, MOST), children);
    percuss_client_free(keeper);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_a_domain),
        cmocka_unit_test(test_nothing_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
