/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/contact/laws.c, law_hertz.c, law_linear.c and law_power.c: what may be asked
 * for is known by its number; force, slope, stored energy and inverse of one law fit together. The
 * pattern for the test of a new law. */
#include "check.h"
#include "contact/hertz.h"
#include "contact/law.h"

/* What every elastic law owes its callers. */
static void check_law(const struct contact_law *law)
{
    const struct contact_law_operations *of = law->operations;
    double slope;
    assert_null(of->curve);
    assert_true(contact_law_force(law, 0.0, &slope) == 0.0);
    assert_true(contact_law_force(law, -1e-6, &slope) == 0.0 && slope == 0.0);
    assert_true(of->stored(law, -1e-6) == 0.0 && of->stored(law, 0.0) == 0.0);
    double before = 0.0;
    for (double d = 1e-12; d < 1e-2; d *= 3.7) {
        double force = contact_law_force(law, d, &slope);
        double ignored;
        double step = 1e-5 * d;
        double above = contact_law_force(law, d + step, &ignored);
        double below = contact_law_force(law, d - step, &ignored);
        assert_true(force > before);
        /* central differences: second order, (1e-5)^2 */
        near_relative(slope, (above - below) / (2.0 * step), 1e-9);
        near_relative(force, (of->stored(law, d + step) - of->stored(law, d - step)) / (2.0 * step),
                      1e-9);
        near_relative(of->indentation(law, force), d, 4e-15); /* a few roundings */
        /* at once as one by one, open ones among them */
        double together[CONTACT_LAW_AT_ONCE], slopes[CONTACT_LAW_AT_ONCE];
        const double places[CONTACT_LAW_AT_ONCE] = {d, -d, 0.0, d + step};
        contact_law_forces(law, places, together, slopes);
        assert_true(together[0] == force && slopes[0] == slope);
        assert_true(together[1] == 0.0 && slopes[1] == 0.0 && together[2] == 0.0);
        assert_true(together[3] == above);
        before = force;
    }
    assert_true(isnan(contact_law_force(law, NAN, &slope)) ||
                contact_law_force(law, NAN, &slope) == 0.0);
}

static void hertz_fits_together(void **state)
{
    (void)state;
    struct contact_law law = contact_law_hertz(7.7e9);
    double slope;
    check_law(&law);
    assert_int_equal(law.operations->model, PERCUSS_CONTACT_HERTZ);
    near_relative(contact_law_force(&law, 1e-4, &slope), 7.7e9 * 1e-6, 1e-15);
    near_relative(slope, 1.5 * 7.7e9 * 1e-2, 1e-15);
    near_relative(law.operations->stored(&law, 1e-4), 0.4 * 7.7e9 * 1e-10, 1e-15);
}

static void linear_fits_together(void **state)
{
    (void)state;
    struct contact_law law = contact_law_linear(3e6);
    double slope;
    check_law(&law);
    near_relative(contact_law_force(&law, 1e-4, &slope), 300.0, 1e-15);
    near_relative(slope, 3e6, 0.0);
    near_relative(law.operations->stored(&law, 1e-4), 0.015, 1e-15);
}

static void power_fits_together(void **state)
{
    (void)state;
    double slope;
    for (double exponent = 1.0; exponent <= 3.0; exponent += 0.5) {
        struct contact_law law = contact_law_power(4e7, exponent, 0.0);
        check_law(&law);
        near_relative(contact_law_force(&law, 1e-4, &slope), 4e7 * pow(1e-4, exponent), 1e-15);
    }
}

/* At rest as every elastic law; moving, slopes by indentation and rate are those of differences,
 * and nothing pulls. */
static void hunt_and_crossleys_fits_together(void **state)
{
    (void)state;
    for (double exponent = 1.0; exponent < 3.0; exponent += 0.5) {
        struct contact_law law = contact_law_dissipative(4e7, exponent, 0.8);
        double (*const moving)(const struct contact_law *, double, double, double *, double *) =
            law.operations->moving;
        double stiffness, viscosity, ignored[2], d = 1e-4;
        check_law(&law);
        for (double rate = -1.2; rate < 2.0; rate += 0.4) {
            double force = moving(&law, d, rate, &stiffness, &viscosity);
            near_relative(force, 4e7 * pow(d, exponent) * (1.0 + 0.8 * rate), 1e-14);
            /* central differences: second order, (1e-5)^2 */
            double step = 1e-5 * d;
            double by = moving(&law, d + step, rate, &ignored[0], &ignored[1]) -
                        moving(&law, d - step, rate, &ignored[0], &ignored[1]);
            near_relative(stiffness, by / (2.0 * step), 1e-9);
            by = moving(&law, d, rate + 1e-3, &ignored[0], &ignored[1]) - force;
            near_relative(viscosity, by / 1e-3, 1e-9);
        }
        /* it parts faster than it recovers */
        assert_true(moving(&law, d, -1.3, &stiffness, &viscosity) == 0.0);
        assert_true(stiffness == 0.0 && viscosity == 0.0);
        assert_true(moving(&law, -d, 1.0, &stiffness, &viscosity) == 0.0);
        assert_true(stiffness == 0.0 && viscosity == 0.0);
        /* followed alone and without micro-slip */
        assert_null(contact_law_refuses(&law, 0));
        assert_non_null(contact_law_refuses(&law, 1));
    }
    const struct contact_law elastic = contact_law_linear(1.0);
    assert_null(contact_law_refuses(&elastic, 1));
}

/* And makes a law of contacts that yield and of those that do not; the latter is sound. */
static void every_model_is_found_by_its_number(void **state)
{
    (void)state;
    const struct material steel = {"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0};
    const struct material soft = {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0};
    const struct hertz_contact hertz =
        hertz_contact_make(hertz_effective_modulus(&steel, &soft), 30.0, 30.0);
    for (unsigned m = 0; m < PERCUSS_CONTACT_COUNT; m++) {
        const struct contact_law_operations *of = contact_law_asked(m);
        double slope;
        assert_int_equal(of->model, m);
        struct contact_law law = of->make(&hertz, &steel, &soft);
        assert_true(contact_law_force(&law, 1e-7, &slope) > 0.0 && slope > 0.0);
        law = of->make(&hertz, &steel, &steel);
        assert_non_null(law.operations->title);
        check_law(&law);
    }
    assert_ptr_equal(contact_law_asked(PERCUSS_CONTACT_COUNT), &contact_law_AUTO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hertz_fits_together),
        cmocka_unit_test(linear_fits_together),
        cmocka_unit_test(power_fits_together),
        cmocka_unit_test(hunt_and_crossleys_fits_together),
        cmocka_unit_test(every_model_is_found_by_its_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
