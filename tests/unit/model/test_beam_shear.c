/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/beam_statics.c: shear factors. */
#include "unit/model/beam_cases.h"

/* Round nu: 6(1 + nu)/(7 + 6 nu) and 10(1 + nu)/(12 + 11 nu) as fractions. */
static void test_cowpers_factors(void **state)
{
    (void)state;
    near(beam_shear_cowper_circle(0.0), 6.0 / 7.0, 1e-15);
    near(beam_shear_cowper_circle(0.3), 39.0 / 44.0, 1e-15);
    near(beam_shear_cowper_rectangle(0.0), 5.0 / 6.0, 1e-15);
    near(beam_shear_cowper_rectangle(0.3), 130.0 / 153.0, 1e-15);
}

/* The theories agree where there is no lateral contraction. */
static void test_without_poissons_ratio(void **state)
{
    (void)state;
    near(beam_shear_hutchinson_circle(0.0), 6.0 / 7.0, 1e-15);
    for (double breadth = 0.01; breadth < 100.0; breadth *= 3.0)
        near(beam_shear_hutchinson_rectangle(0.0, 1.0, breadth), 5.0 / 6.0, 1e-15);
}

/* Plane stress: k = 5(1 + nu)/(6 + 5 nu), Stephen's discussion of Hutchinson's paper. */
static void test_thin_rectangle(void **state)
{
    (void)state;
    for (double nu = -0.9; nu < 0.5; nu += 0.1)
        near(beam_shear_hutchinson_rectangle(nu, 1.0, 1e-6), 5.0 * (1.0 + nu) / (6.0 + 5.0 * nu),
             1e-10);
}

/* Hutchinson's general expression with Saint-Venant's flexure function, the latter fitted by
 * harmonic polynomials on the rim (numpy, least squares, good to some 1e-7; the same script gave
 * the circle's closed form to 1e-13). */
static void test_rectangle_against_the_flexure_function(void **state)
{
    (void)state;
    static const struct {
        double poisson, ratio, factor;
    } rows[] = {
        {0.3, 0.5, 0.8670906}, {0.3, 1.0, 0.8722717}, {0.3, 2.0, 0.9267370},
        {0.5, 0.5, 0.8832703}, {0.5, 1.0, 0.8945634}, {0.5, 2.0, 1.0232407},
    };

    for (size_t i = 0; i < COUNT(rows); i++)
        near(beam_shear_hutchinson_rectangle(rows[i].poisson, 0.03, 0.03 * rows[i].ratio),
             rows[i].factor, 1e-6 * rows[i].factor);
}

/* The series summed to 40 digits (mpmath). Wide sections have a pole and then negative factors, as
 * the paper says. */
static void test_rectangle_digits(void **state)
{
    (void)state;
    near(beam_shear_hutchinson_rectangle(0.3, 1.0, 1e-3), 0.86666666666667466, 1e-15);
    near(beam_shear_hutchinson_rectangle(0.3, 1.0, 0.1), 0.86666744227063008, 1e-15);
    near(beam_shear_hutchinson_rectangle(0.3, 1.0, 1.0), 0.87227178295181927, 2e-15);
    near(beam_shear_hutchinson_rectangle(0.3, 1.0, 3.0), 1.0955645958421165, 1e-14);
    near(beam_shear_hutchinson_rectangle(0.3, 1.0, 30.0), -0.02282149761439084, 1e-11);
}

static void test_hutchinsons_circle(void **state)
{
    (void)state;
    near(beam_shear_hutchinson_circle(0.3), 6.0 * 1.69 / 10.96, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cowpers_factors),
        cmocka_unit_test(test_without_poissons_ratio),
        cmocka_unit_test(test_thin_rectangle),
        cmocka_unit_test(test_rectangle_against_the_flexure_function),
        cmocka_unit_test(test_rectangle_digits),
        cmocka_unit_test(test_hutchinsons_circle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
