/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests idl/percuss/fields.h: its lists have the members of the structs in percuss_wire.idl, all of
 * them. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "percuss/fields.h"

#define NAME(kind, name, ...) #name,
#define LIST(fields)          ((const char *const[]){fields(NAME, NAME) NULL})

#define REPLY(F, L)          PERCUSS_HEAD_FIELDS(F) PERCUSS_REPLY_FIELDS(F, L)
#define ENSEMBLE_REPLY(F, L) PERCUSS_HEAD_FIELDS(F) PERCUSS_ENSEMBLE_REPLY_FIELDS(F, L)
/* how many clients are to hear of: no part of what they are told */
#define SERVER_STATUS(F, L) PERCUSS_SERVER_FIELDS(F, L) F(, others)
/* who asks whom, about which impact, and that it is enough: no part of the question */
#define ENSEMBLE_REQUEST(F, L)                                                                     \
    F(, client)                                                                                    \
    F(, sequence) F(, server) F(, scene) F(, cancel) F(, list_tangential)                          \
        PERCUSS_ENSEMBLE_FIELDS(F, L)

enum { MOST = 64, SIZE = 64 };

/* The names of a struct's members in the IDL: the last words before semicolons or sizes. */
static size_t read_members(const char *structure, char names[MOST][SIZE])
{
    char line[512], start[SIZE];
    size_t count = 0;
    bool inside = false;
    snprintf(start, sizeof start, "struct %s {", structure);
    FILE *file = fopen(PERCUSS_SOURCE_DIR "/idl/percuss_wire.idl", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file) && !(inside && strstr(line, "};"))) {
        char *end = strpbrk(line, "/;"),
             *name = end ? memrchr(line, ' ', (size_t)(end - line)) : NULL;
        if (inside && name && *end == ';') {
            name += 1 + (name[1] == '_'); /* a keyword of the IDL */
            assert_true(count < MOST && sscanf(name, "%63[a-z0-9_]", names[count]) == 1);
            count++;
        }
        inside = inside || strstr(line, start);
    }
    fclose(file);
    return count;
}

static void expect(const char *structure, const char *const *fields)
{
    char names[MOST][SIZE];
    size_t count = read_members(structure, names), listed = 0;
    for (; fields[listed]; listed++) {
        size_t i = 0;
        while (i < count && strcmp(names[i], fields[listed]))
            i++;
        if (i == count)
            fail_msg("%s of the IDL has no %s", structure, fields[listed]);
    }
    if (listed != count)
        fail_msg("%s has %zu members in the IDL, and %zu in the list", structure, count, listed);
}

static void requests(void **state)
{
    (void)state;
    expect("BodyMotion", LIST(PERCUSS_BODY_FIELDS));
    expect("Contact", LIST(PERCUSS_CONTACT_FIELDS));
    expect("Options", LIST(PERCUSS_OPTION_FIELDS));
    expect("EnsembleInput", LIST(PERCUSS_INPUT_FIELDS));
    expect("EnsembleCorrelation", LIST(PERCUSS_CORRELATION_FIELDS));
    expect("EnsembleRequest", LIST(ENSEMBLE_REQUEST));
}

static void replies(void **state)
{
    (void)state;
    expect("SubImpact", LIST(PERCUSS_SUB_IMPACT_FIELDS));
    expect("ContactResult", LIST(PERCUSS_CONTACT_RESULT_FIELDS));
    expect("BodyVelocity", LIST(PERCUSS_BODY_VELOCITY_FIELDS));
    expect("BodyState", LIST(PERCUSS_BODY_STATE_FIELDS));
    expect("BodyEnergy", LIST(PERCUSS_BODY_ENERGY_FIELDS));
    expect("Energy", LIST(PERCUSS_ENERGY_FIELDS));
    expect("ErrorEstimate", LIST(PERCUSS_ERROR_FIELDS));
    expect("BodyModel", LIST(PERCUSS_BODY_MODEL_FIELDS));
    expect("Model", LIST(PERCUSS_MODEL_FIELDS));
    expect("Timing", LIST(PERCUSS_TIMING_FIELDS));
    expect("Reply", LIST(REPLY));
}

static void announcements(void **state)
{
    (void)state;
    expect("ServerStatus", LIST(SERVER_STATUS));
    expect("Task", LIST(PERCUSS_TASK_FIELDS));
    expect("Dent", LIST(PERCUSS_DENT_FIELDS));
}

static void reports(void **state)
{
    (void)state;
    expect("Statistic", LIST(PERCUSS_STATISTIC_FIELDS));
    expect("InputPart", LIST(PERCUSS_INPUT_PART_FIELDS));
    expect("Sensitivity", LIST(PERCUSS_SENSITIVITY_FIELDS));
    expect("SigmaInterval", LIST(PERCUSS_SIGMA_INTERVAL_FIELDS));
    expect("BetaFit", LIST(PERCUSS_BETA_FIT_FIELDS));
    expect("EnsembleCheck", LIST(PERCUSS_ENSEMBLE_CHECK_FIELDS));
    expect("EnsembleReply", LIST(ENSEMBLE_REPLY));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(requests),
        cmocka_unit_test(replies),
        cmocka_unit_test(reports),
        cmocka_unit_test(announcements),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
