/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/modal.c: a rough table's steps pass its knots, against CVODE, which
 * shortens its steps there, and against the same steps without the correction. */
#include "contact/law_closed_form.h"
#include "contact/plastic.h"
#include "unit/contact/sampled_table.h"
#include "unit/impact/toy_scene.h"

/* Every other force is wrong by 5e-4, as a computed contact region's are. */
static struct contact_curves *rough_curves(void)
{
    static const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
    static const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
    static struct sampled_table sampled;
    struct fault fault = {""};
    struct contact_curves *curves;
    struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 0.5 / 0.015, 0.5 / 0.015);
    struct contact_law closed = contact_law_closed_form(&hertz, &steel, &soft);
    sampled_table_make(&sampled, &closed, 60.0);
    for (int i = 9; i < SAMPLED_POINTS; i += 2)
        sampled.force[i] *= 1.0 + 5e-4;
    assert_int_equal(contact_curves_create(&sampled.table, &curves, &fault), PERCUSS_OK);
    return curves;
}

static double rebound(const struct contact_law *law, double speed, bool cvode, double accuracy)
{
    struct toy toy;
    struct impact_outcome outcome;
    struct impact_settings settings = {.accuracy = accuracy, .horizon = 0.02, .max_work = 1e9};
    static const double omega[] = {3e4, 7e4, 1.1e5, 1.9e5};
    static const double participation[] = {1.5, -1.9, 1.4, 2.0};
    toy_init(&toy, 1);
    toy.laws[0] = *law;
    toy.w[0] = 1.0 / 0.11;
    toy.gap_rate[0] = -speed;
    toy.residual[0] = 2e-9;
    toy_add(&toy, 1, 4, omega, 0.0, participation);
    assert_true(impact_create(&outcome, &toy.scene, &toy.arena));
    assert_int_equal(
        (cvode ? impact_cvode : impact_modal)(&toy.scene, &settings, &toy.arena, &outcome),
        PERCUSS_OK);
    double after = outcome.motion.gap_rate[0] / speed;
    toy_free(&toy);
    return after;
}

static void steps_pass_knots(void **state)
{
    (void)state;
    static const double speeds[] = {0.05, 0.1, 0.2, 0.3, 0.5};
    struct contact_curves *curves = rough_curves();
    struct contact_law law = contact_law_table(curves);
    /* the same law, whose knots nobody knows */
    struct contact_law plain = law;
    struct contact_law_operations operations = *law.operations;
    struct plastic_curve curve = *operations.curve;
    curve.knots = NULL;
    operations.curve = &curve;
    plain.operations = &operations;
    double with = 0.0;
    double without = 0.0;
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
        double exact = rebound(&law, speeds[i], true, 1e-10);
        /* short steps need no correction */
        measured("short steps", rebound(&plain, speeds[i], false, 1e-14), exact, 2e-8);
        with = fmax(with, fabs(rebound(&law, speeds[i], false, 1e-6) - exact));
        without = fmax(without, fabs(rebound(&plain, speeds[i], false, 1e-6) - exact));
    }
    measured("with the correction", with, 0.0, 1e-6);
    measured("without it", without, 0.0, 1e-3);
    /* what is left are their sixth powers, and knots that do not count */
    assert_true(without > 5.0 * with);
    contact_curves_free(curves);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_pass_knots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
