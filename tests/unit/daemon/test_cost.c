/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests daemon/client_job.c: what the reading thread may solve, and what is for the long lane. */
#include "check.h"
#include "daemon/client_job.h"
#include "percuss/vocabulary.h"

static percuss_v1_Request request_of(double tolerance, unsigned model, unsigned method)
{
    percuss_v1_Request request = {.contacts._length = 1};
    request.options.tolerance = tolerance;
    request.options.contact_model = model;
    request.options.method = method;
    return request;
}

static void costs_by_options(void **state)
{
    (void)state;
    static const struct {
        double tolerance;
        unsigned model, method;
        bool cheap, is_long;
    } cases[] = {
        /* the default tolerance is a coarse one */
        {0.0, PERCUSS_CONTACT_AUTO, PERCUSS_METHOD_MODAL, true, false},
        {1e-4, PERCUSS_CONTACT_HERTZ, PERCUSS_METHOD_MODAL, true, false},
        {1e-5, PERCUSS_CONTACT_HERTZ, PERCUSS_METHOD_MODAL, false, false},
        {1e-9, PERCUSS_CONTACT_CLOSED_FORM, PERCUSS_METHOD_MODAL, false, false},
        {1e-10, PERCUSS_CONTACT_HERTZ, PERCUSS_METHOD_MODAL, false, true},
        {1e-3, PERCUSS_CONTACT_TABLE, PERCUSS_METHOD_MODAL, false, false},
        {1e-3, PERCUSS_CONTACT_COMPLETE_FE, PERCUSS_METHOD_MODAL, false, true},
        {1e-3, PERCUSS_CONTACT_HERTZ, PERCUSS_METHOD_CVODE, false, true},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        percuss_v1_Request request =
            request_of(cases[i].tolerance, cases[i].model, cases[i].method);
        assert_int_equal(impact_job_is_cheap(&request), cases[i].cheap);
        assert_int_equal(impact_job_is_long(&request.options), cases[i].is_long);
    }
}

static void what_asks_for_more_is_not_cheap(void **state)
{
    (void)state;
    percuss_v1_Request pair = request_of(0.0, PERCUSS_CONTACT_AUTO, PERCUSS_METHOD_MODAL);
    percuss_v1_Request conditioned = pair, traced = pair;
    pair.contacts._length = 2;
    conditioned.options.conditioning = true;
    traced.options.trace = true;
    assert_false(impact_job_is_cheap(&pair));
    assert_false(impact_job_is_cheap(&conditioned));
    assert_false(impact_job_is_cheap(&traced));
    assert_false(impact_job_is_long(&traced.options));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(costs_by_options),
        cmocka_unit_test(what_asks_for_more_is_not_cheap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
