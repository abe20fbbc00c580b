/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Ensembles that cannot be: what is refused, and in which words. */
#include "physics/ensemble_lab.h"

static void refused(struct ensemble_lab *e, const char *words)
{
    struct fault fault = {""};
    assert_int_equal(ensemble_create(&e->ensemble, &e->spec, NULL, &fault), PERCUSS_BAD_REQUEST);
    if (!strstr(fault.text, words))
        fail_msg("'%s' does not say '%s'", fault.text, words);
}

static void refusals(void **state)
{
    (void)state;
    struct ensemble_lab e;
    ensemble_lab_open(&e);
    e.spec.input_count = 0;
    refused(&e, "inputs: none given");
    e.spec.input_count = 2;
    e.inputs[1] = e.inputs[0];
    refused(&e, "speed: is inputs[0] already");
    e.inputs[1] = uncertain(INPUT_SITE, 0, DISTRIBUTION_IS_CONSTANT, 0.5, 0.0);
    refused(&e, "sphere: must be a beam");
    e.inputs[1] = uncertain(INPUT_YOUNG, 1, DISTRIBUTION_IS_CONSTANT, 70.0, 0.0);
    refused(&e, "inputs[1].first: 70");
    e.spec.input_count = 1;
    e.spec.samples = 0;
    refused(&e, "samples: 0");
    e.spec.samples = 3000000;
    refused(&e, "samples: 3000000");
    e.spec.samples = 10;
    e.spec.contact = 1;
    refused(&e, "contact: 1");
    e.spec.contact = 0;
    e.spec.half_width = -1.0;
    refused(&e, "half_width: -1");
    struct copula_pair pair = {0, 5, 0.5};
    e.spec.half_width = 0.0;
    e.spec.correlations = &pair;
    e.spec.correlation_count = 1;
    refused(&e, "correlations[0]: inputs 0 and 5");
    lab_free(e.lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
