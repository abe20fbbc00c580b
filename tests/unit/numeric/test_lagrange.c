/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/numeric/lagrange.c: the polynomials through five places are exact for powers
 * up to the fourth, at places and between them. */
#include "numeric/lagrange.h"

#include <math.h>

#include "check.h"

static const double PLACE[] = {0.0, 0.07, 0.41, 0.79, 1.0};
enum { PLACES = sizeof PLACE / sizeof *PLACE };

static void powers_and_their_slopes(void **state)
{
    (void)state;
    for (double s = -0.1; s < 1.2; s += 0.1)
        for (int power = 0; power < PLACES; power++) {
            double by[PLACES], slope_by[PLACES], value = 0.0, slope = 0.0;
            lagrange_values(PLACE, PLACES, s, by);
            lagrange_slopes(PLACE, PLACES, s, slope_by);
            for (int j = 0; j < PLACES; j++) {
                value += by[j] * pow(PLACE[j], power);
                slope += slope_by[j] * pow(PLACE[j], power);
            }
            /* weights of some ten, slopes of some hundred, times rounding */
            near(value, pow(s, power), 1e-13);
            near(slope, power ? power * pow(s, power - 1) : 0.0, 1e-12);
        }
}

static void one_at_its_place(void **state)
{
    (void)state;
    for (int i = 0; i < PLACES; i++) {
        double by[PLACES];
        lagrange_values(PLACE, PLACES, PLACE[i], by);
        for (int j = 0; j < PLACES; j++)
            assert_true(by[j] == (i == j));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(powers_and_their_slopes),
        cmocka_unit_test(one_at_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
