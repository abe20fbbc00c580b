/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Compares idl/percuss/vocabulary.h with the constants of idl/percuss_wire.idl. */
#include "sample.h"

#include "model/body.h"

#define STATUS(name, text) assert_int_equal(PERCUSS_##name, percuss_v1_STATUS_##name);
#define END(name, text)    assert_int_equal(PERCUSS_END_##name, percuss_v1_END_REASON_##name);
#define MODEL(name, text)  assert_int_equal(PERCUSS_CONTACT_##name, percuss_v1_CONTACT_MODEL_##name);
#define METHOD(name, text) assert_int_equal(PERCUSS_METHOD_##name, percuss_v1_METHOD_##name);
#define YIELDING(name, text)                                                                       \
    assert_int_equal(PERCUSS_COMPLIANCE_##name, percuss_v1_COMPLIANCE_##name);
#define DENTS(name, text)    assert_int_equal(PERCUSS_DENTS_##name, percuss_v1_DENTS_##name);
#define FRICTION(name, text) assert_int_equal(PERCUSS_FRICTION_##name, percuss_v1_FRICTION_##name);
#define SLID(name, text)                                                                           \
    assert_int_equal(PERCUSS_FRICTION_STATE_##name, percuss_v1_FRICTION_STATE_##name);
#define PARAMETER(name, text)                                                                      \
    assert_int_equal(PERCUSS_PARAMETER_##name, percuss_v1_PARAMETER_##name);
#define SOURCE(name, text)                                                                         \
    assert_int_equal(PERCUSS_DELASSUS_##name, percuss_v1_DELASSUS_SOURCE_##name);

static void numbers_are_those_of_the_wire(void **state)
{
    (void)state;
    PERCUSS_STATUS_LIST(STATUS)
    PERCUSS_END_REASON_LIST(END)
    PERCUSS_CONTACT_MODEL_LIST(MODEL)
    PERCUSS_METHOD_LIST(METHOD)
    PERCUSS_COMPLIANCE_LIST(YIELDING)
    PERCUSS_DENTS_LIST(DENTS)
    PERCUSS_FRICTION_LIST(FRICTION)
    PERCUSS_FRICTION_STATE_LIST(SLID)
    PERCUSS_PARAMETER_LIST(PARAMETER)
    PERCUSS_DELASSUS_SOURCE_LIST(SOURCE)
    assert_int_equal(SUPPORT_FREE, percuss_v1_SUPPORT_FREE);
    assert_int_equal(SUPPORT_PINNED, percuss_v1_SUPPORT_PINNED);
    assert_int_equal(SUPPORT_CLAMPED, percuss_v1_SUPPORT_CLAMPED);
}

static void sizes_are_those_of_the_wire(void **state)
{
    (void)state;
    assert_int_equal(PERCUSS_ID_SIZE, sizeof((percuss_v1_BodyMotion *)NULL)->id);
    assert_int_equal(PERCUSS_ID_SIZE, sizeof((percuss_v1_BodyState *)NULL)->state);
    assert_int_equal(sizeof((struct solve_result *)NULL)->reason,
                     sizeof((percuss_v1_Model *)NULL)->reason);
    /* what the solver says must fit */
    assert_true(sizeof(struct fault) <= sizeof((percuss_v1_Reply *)NULL)->message);
}

/* The lists say how many constants there are; one more in the IDL alone would be missed otherwise.
 */
static void the_idl_has_no_other_constants(void **state)
{
    (void)state;
    static const struct {
        const char *prefix;
        int count;
    } families[] = {
        {"STATUS_", PERCUSS_STATUS_COUNT},
        {"END_REASON_", PERCUSS_END_COUNT},
        {"CONTACT_MODEL_", PERCUSS_CONTACT_COUNT},
        {"METHOD_", PERCUSS_METHOD_COUNT},
        {"COMPLIANCE_", PERCUSS_COMPLIANCE_COUNT},
        {"DENTS_", PERCUSS_DENTS_COUNT},
        {"FRICTION_", PERCUSS_FRICTION_COUNT + PERCUSS_FRICTION_STATE_COUNT},
        {"FRICTION_STATE_", PERCUSS_FRICTION_STATE_COUNT},
        {"DELASSUS_SOURCE_", PERCUSS_DELASSUS_COUNT},
        {"PARAMETER_", PERCUSS_PARAMETER_COUNT},
        {"SUPPORT_", SUPPORT_CLAMPED + 1},
    };
    FILE *file = fopen(PERCUSS_SOURCE_DIR "/idl/percuss_wire.idl", "r");
    assert_non_null(file);
    int found[sizeof families / sizeof *families] = {0};
    char line[512], name[64];
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, " const unsigned long %63s", name) != 1)
            continue;
        for (size_t i = 0; i < sizeof families / sizeof *families; i++)
            found[i] += strncmp(name, families[i].prefix, strlen(families[i].prefix)) == 0;
    }
    fclose(file);
    for (size_t i = 0; i < sizeof families / sizeof *families; i++)
        assert_int_equal(found[i], families[i].count);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_those_of_the_wire),
        cmocka_unit_test(sizes_are_those_of_the_wire),
        cmocka_unit_test(the_idl_has_no_other_constants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
