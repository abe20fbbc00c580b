/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests client/twins/percuss_measured.c and percuss_calibrate.c, by a client in this process: what
 * is wrong is named, twins are those that the client answers, parameters are found again. */

#include <math.h>
#include <percuss/local.h>
#include <percuss/measured.h>
#include <string.h>

#include "check.h"

#define CATALOGUE PERCUSS_SOURCE_DIR "/config/catalogue.yaml"
#define BEAM      PERCUSS_SOURCE_DIR "/client/examples/measured/synthetic-beam.csv"
#define CAMERA    PERCUSS_SOURCE_DIR "/client/examples/measured/synthetic-camera.csv"

/* The steel sphere on a body of the catalogue. */
struct rig {
    struct percuss_client *client;
    struct percuss_body_list bodies;
    struct percuss_measured_question question;
};

static struct rig rig_open(const char *b)
{
    struct rig rig;
    struct percuss_local_config config = percuss_local_config_default();
    config.catalogue = CATALOGUE;
    assert_int_equal(percuss_local_open(&config, &rig.client), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_bodies(rig.client, 0.0, &rig.bodies), PERCUSS_RESULT_OK);
    rig.question = percuss_measured_question_default(rig.client,
                                                     percuss_body_find(&rig.bodies, "steel-sphere"),
                                                     percuss_body_find(&rig.bodies, b));
    return rig;
}

static void rig_close(struct rig *rig)
{
    percuss_body_list_free(&rig->bodies);
    percuss_client_free(rig->client);
}

static const struct percuss_measured_impact UNKNOWN = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};

static struct percuss_measured_impact impact_of(double speed, double restitution)
{
    struct percuss_measured_impact impact = UNKNOWN;
    impact.speed = speed;
    impact.restitution = restitution;
    return impact;
}

static void says(const char *expected)
{
    if (!strstr(percuss_measured_error_text(), expected))
        fail_msg("'%s' does not say '%s'", percuss_measured_error_text(), expected);
}

static void test_impacts_are_checked(void **state)
{
    struct percuss_measured *measured = (struct percuss_measured *)&measured;
    struct percuss_measured_impact impacts[2] = {impact_of(0.1, 0.5), impact_of(0.2, 0.6)};
    (void)state;
    assert_int_equal(percuss_measured_create(0, impacts, &measured),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("impacts: none");
    assert_null(measured);
    impacts[1].at = 1.5;
    assert_int_equal(percuss_measured_create(2, impacts, &measured),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("impacts[1].at: 1.5: a fraction 0..1 or NAN is allowed");
    impacts[1] = impact_of(0.2, NAN);
    assert_int_equal(percuss_measured_create(2, impacts, &measured),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("impacts[1].restitution: unknown");
    /* an impulse does as well */
    impacts[1].impulse = 0.02;
    assert_int_equal(percuss_measured_create(2, impacts, &measured), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_measured_count(measured), 2);
    percuss_measured_free(measured);
    percuss_measured_free(NULL);
    assert_int_equal(percuss_measured_read("/none.csv", 0, NULL, &measured),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("none.csv");
    assert_null(measured);
}

/* Of a file, and with INVALID_ARGUMENT. */
static void refuses_file(struct percuss_measured_file file, const char *expected)
{
    struct percuss_measured *measured = (struct percuss_measured *)&measured;
    file.file = CAMERA;
    assert_int_equal(percuss_measured_read_file(&file, &measured), PERCUSS_RESULT_INVALID_ARGUMENT);
    says(expected);
    assert_null(measured);
}

static void test_what_is_said_of_a_file_is_checked(void **state)
{
    static const char *const wrong[] = {"drop=1mm", "colour=1"};
    (void)state;
    refuses_file((struct percuss_measured_file){.scale = -1.0},
                 "scale: -1: m > 0, or 0 where it is not said, is allowed");
    refuses_file((struct percuss_measured_file){.rate = NAN}, "rate: nan: Hz > 0");
    refuses_file((struct percuss_measured_file){.gravity = INFINITY}, "gravity: inf: m/s^2 > 0");
    refuses_file((struct percuss_measured_file){.uncertainty_count = 2, .uncertainties = wrong},
                 "uncertainties[1]: 'colour=1': NAME=VALUE is needed");
    refuses_file((struct percuss_measured_file){.column_count = 1}, "columns: NULL");
}

static void test_an_interval_comes_back_with_its_impact(void **state)
{
    struct rig rig = rig_open("al-rod");
    struct percuss_measured *measured;
    struct percuss_comparison comparison;
    struct percuss_measured_impact impacts[2] = {impact_of(0.1, 0.7), impact_of(0.3, NAN)};
    (void)state;
    impacts[1].impulse = 0.02;
    impacts[1].restitution_half_width = 0.01;
    assert_int_equal(percuss_measured_create(2, impacts, &measured),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("impacts[1].restitution_half_width: 0.01: must be 0 or NAN where the restitution is "
         "unknown");
    impacts[1].restitution_half_width = 0.0;
    impacts[0].restitution_half_width = -0.01;
    assert_int_equal(percuss_measured_create(2, impacts, &measured),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("impacts[0].restitution_half_width: -0.01: a number > 0");
    impacts[0].restitution_half_width = 0.01;
    assert_int_equal(percuss_measured_create(2, impacts, &measured), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_measured_compare(measured, &rig.question, &comparison),
                     PERCUSS_RESULT_OK);
    assert_true(fabs(comparison.impacts[0].measured.restitution_half_width - 0.01) < 1e-15);
    assert_true(isnan(comparison.impacts[1].measured.restitution_half_width));
    assert_true(isnan(comparison.impacts[0].simulated.restitution_half_width));
    percuss_comparison_free(&comparison);
    percuss_measured_free(measured);
    rig_close(&rig);
}

static void test_twins_are_what_the_client_answers(void **state)
{
    struct rig rig = rig_open("al-rod");
    struct percuss_measured *measured;
    struct percuss_comparison comparison;
    struct percuss_request request;
    struct percuss_reply reply;
    const struct percuss_measured_impact impacts[2] = {impact_of(0.1, 0.7), impact_of(0.3, 0.6)};
    double sum = 0.0;
    (void)state;
    assert_int_equal(percuss_measured_create(2, impacts, &measured), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_measured_compare(measured, &rig.question, &comparison),
                     PERCUSS_RESULT_OK);
    assert_int_equal(comparison.impact_count, 2);
    for (int i = 0; i < 2; i++) {
        /* asked of the client alone */
        rig.question.pair.speed = impacts[i].speed;
        assert_int_equal(percuss_contact_pair(&rig.question.pair, &request), PERCUSS_RESULT_OK);
        assert_int_equal(percuss_solve(rig.client, &request, 60.0, &reply), PERCUSS_RESULT_OK);
        const struct percuss_measured_twin *twin = &comparison.impacts[i];
        assert_true(twin->simulated.restitution == reply.contacts[0].restitution);
        assert_true(twin->residual == twin->simulated.restitution - impacts[i].restitution);
        /* the impulse follows from e and the masses, Eq. (6) */
        double w = reply.contacts[0].inverse_effective_mass;
        double impulse = (1.0 + impacts[i].restitution) * impacts[i].speed / w;
        assert_true(fabs(twin->measured.impulse - impulse) < 1e-15);
        sum += twin->residual;
        percuss_reply_free(&reply);
    }
    assert_true(fabs(comparison.residual_mean - 0.5 * sum) < 1e-15);
    assert_true(comparison.energy_distance.p > 0.0 && comparison.energy_distance.p <= 1.0);
    percuss_comparison_free(&comparison);
    percuss_comparison_free(&comparison);
    percuss_measured_free(measured);
    rig_close(&rig);
}

static void refuses(const struct percuss_measured *measured, struct percuss_measured_question asked,
                    const char *expected)
{
    struct percuss_comparison comparison;
    assert_int_equal(percuss_measured_compare(measured, &asked, &comparison),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says(expected);
    assert_null(comparison.impacts);
}

static void test_questions_are_checked(void **state)
{
    struct rig rig = rig_open("al-rod");
    struct percuss_measured *measured;
    const struct percuss_measured_impact impact = impact_of(0.1, 0.7);
    struct percuss_measured_question asked = rig.question;
    (void)state;
    assert_int_equal(percuss_measured_create(1, &impact, &measured), PERCUSS_RESULT_OK);
    asked.client = NULL;
    refuses(measured, asked, "client: NULL");
    asked = rig.question;
    asked.pair.b = NULL;
    refuses(measured, asked, "pair.b: NULL");
    asked = rig.question;
    asked.permutations = 1000001;
    refuses(measured, asked, "permutations: 1000001: 1..1000000");
    asked = rig.question;
    asked.noise = NAN;
    refuses(measured, asked, "noise: nan");
    asked = rig.question;
    asked.options.tolerance = 7.0;
    refuses(measured, asked, "impact 1: BAD_REQUEST: ");
    percuss_measured_free(measured);
    rig_close(&rig);
}

static void test_a_modulus_is_found_again(void **state)
{
    struct rig rig = rig_open("al-beam");
    struct percuss_measured *measured;
    struct percuss_calibration found = {
        .parameter_count = 1,
        .parameters = {{.parameter = PERCUSS_PARAMETER_YOUNG, .body = "al-beam", .start = NAN}}};
    (void)state;
    assert_int_equal(percuss_measured_read(BEAM, 0, NULL, &measured), PERCUSS_RESULT_OK);
    /* what cannot be fitted */
    strcpy(found.parameters[0].body, "al-rod");
    assert_int_equal(percuss_measured_calibrate(measured, &rig.question, &found),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("parameters[0].body: 'al-rod': steel-sphere or al-beam is allowed");
    strcpy(found.parameters[0].body, "al-beam");
    found.parameters[0].parameter = PERCUSS_PARAMETER_COUNT;
    assert_int_equal(percuss_measured_calibrate(measured, &rig.question, &found),
                     PERCUSS_RESULT_INVALID_ARGUMENT);
    says("parameters[0].parameter: ");
    /* the measurements were made with 72.5 GPa, the catalogue says 70 */
    found.parameters[0].parameter = PERCUSS_PARAMETER_YOUNG;
    assert_int_equal(percuss_measured_calibrate(measured, &rig.question, &found),
                     PERCUSS_RESULT_OK);
    const struct percuss_fitted *young = &found.parameters[0];
    assert_true(young->start == 70e9);
    assert_true(young->low < 72.5e9 && 72.5e9 < young->high && young->determined);
    assert_true(found.correlation[0][0] == 1.0);
    assert_int_equal(found.impacts, percuss_measured_count(measured));
    percuss_calibration_free(&found);
    percuss_measured_free(measured);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_impacts_are_checked),
        cmocka_unit_test(test_what_is_said_of_a_file_is_checked),
        cmocka_unit_test(test_an_interval_comes_back_with_its_impact),
        cmocka_unit_test(test_twins_are_what_the_client_answers),
        cmocka_unit_test(test_questions_are_checked),
        cmocka_unit_test(test_a_modulus_is_found_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
