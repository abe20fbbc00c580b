/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/base/units.c. */
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "check.h"

#ifdef PERCUSS_HAVE_UDUNITS
#include <udunits2.h>
#endif

static double good(const char *text, enum quantity quantity)
{
    double value = NAN;
    enum units_problem problem = units_read(text, quantity, &value);
    if (problem)
        fail_msg("%s: problem %d", text, problem);
    return value;
}

static void bad(const char *text, enum quantity quantity, enum units_problem expected)
{
    double value;
    enum units_problem problem = units_read(text, quantity, &value);
    if (problem != expected)
        fail_msg("'%s': %d, not %d", text, problem, expected);
}

static void bits(const char *text, enum quantity quantity, double expected)
{
    double value = good(text, quantity);
    if (memcmp(&value, &expected, sizeof value) != 0)
        fail_msg("%s: %.17g is not %.17g", text, value, expected);
}

static void test_values_are_those_of_si_to_the_bit(void **state)
{
    (void)state;
    bits("70 GPa", QUANTITY_STRESS, 70e9);
    bits("70GPa", QUANTITY_STRESS, 70e9);
    bits("205 MPa", QUANTITY_STRESS, 205e6);
    bits("2.1e5 N/mm^2", QUANTITY_STRESS, 2.1e11);
    bits("2.1e5 N/mm2", QUANTITY_STRESS, 2.1e11);
    bits("2100 kbar", QUANTITY_STRESS, 2.1e11);
    bits("8 mm", QUANTITY_LENGTH, 0.008);
    bits("15.35 cm", QUANTITY_LENGTH, 0.1535);
    bits("1e-3m", QUANTITY_LENGTH, 1e-3);
    bits(".5 \xC2\xB5m", QUANTITY_LENGTH, 0.5e-6);
    bits("+5. um", QUANTITY_LENGTH, 5e-6);
    bits("-0 mm", QUANTITY_LENGTH, 0.0);
    bits("2.7 g/cm^3", QUANTITY_DENSITY, 2700.0);
    bits("2.7 g/cm\xC2\xB3", QUANTITY_DENSITY, 2700.0);
    bits("2.7 g cm^-3", QUANTITY_DENSITY, 2700.0);
    bits("2.7 g*cm-3", QUANTITY_DENSITY, 2700.0);
    bits("7.85e-9 t/mm^3", QUANTITY_DENSITY, 7850.0);
    bits("7.85 kg/dm^3", QUANTITY_DENSITY, 7850.0);
    bits("20 kHz", QUANTITY_FREQUENCY, 20e3);
    bits("20 1/ms", QUANTITY_FREQUENCY, 20e3);
    bits("0.005 1/mm", QUANTITY_CURVATURE, 5.0);
    bits("300 mm/s", QUANTITY_SPEED, 0.3);
    bits("9mm/s", QUANTITY_SPEED, 0.009);
    bits("36 km/h", QUANTITY_SPEED, 10.0);
    bits("20ms", QUANTITY_TIME, 0.02);
    bits("1.5 min", QUANTITY_TIME, 90.0);
    bits("30 mN s", QUANTITY_IMPULSE, 0.03);
    bits("30 g m/s", QUANTITY_IMPULSE, 0.03);
    bits("0.3", QUANTITY_NUMBER, 0.3);
    bits("70e9", QUANTITY_STRESS, 70e9);
}

/* Not so if the number were read first and multiplied by 0.001: 9 * 0.001 is not 0.009. */
static void test_thousands_of_millimetres(void **state)
{
    (void)state;
    char text[40], plain[40];
    for (int i = 1; i <= 20000; i++) {
        snprintf(text, sizeof text, "%d mm", i);
        snprintf(plain, sizeof plain, "%de-3", i);
        bits(text, QUANTITY_LENGTH, strtod(plain, NULL));
        snprintf(text, sizeof text, "%d.25e1 GPa", i);
        snprintf(plain, sizeof plain, "%d.25e10", i);
        bits(text, QUANTITY_STRESS, strtod(plain, NULL));
    }
}

/* Definitions of 1959; g = 9.80665 m/s^2. A product and a quotient are rounded: two units in the
 * last place. */
static void test_inches_and_pounds(void **state)
{
    (void)state;
    bits("1 in", QUANTITY_LENGTH, 0.0254);
    bits("1 ft", QUANTITY_LENGTH, 0.3048);
    near_relative(good("30e6 psi", QUANTITY_STRESS),
                  30e6 * 0.45359237 * 9.80665 / (0.0254 * 0.0254), 2.0 * 2.3e-16);
    bits("2 g", QUANTITY_ACCELERATION, 2.0 * 9.80665);
    near_relative(good("60 mph", QUANTITY_SPEED), 26.8224, 2.3e-16);
    near_relative(good("60 mi/h", QUANTITY_SPEED), 26.8224, 2.3e-16);
    near_relative(good("30 Mpsi", QUANTITY_STRESS), good("30e6 psi", QUANTITY_STRESS), 2.3e-16);
    near_relative(good("0.284 lb/in^3", QUANTITY_DENSITY), 0.284 * 0.45359237 / pow(0.0254, 3),
                  4.0 * 2.3e-16);
}

static void test_what_is_refused(void **state)
{
    (void)state;
    static const char *const none[] = {"",  " ",   "mm", "nan", "inf",   ".inf",
                                       "-", "+-1", ".",  "e5",  "1e999", "1e300 Tm"};
    static const char *const unknown[] = {
        "8 furlong", "8 M",    "8 mmm",  "0x10",   "1_000", "1:30",  "8 m/",  "8 /m",  "8 m^",
        "8 m^-",     "8 m^22", "8 m//s", "8 m**s", "8 m, ", "8 2 m", "8 1/1", "8 kkg", "8 kin",
        "8 \xC2m",   "8 \xC2", "8 1",    "8 m 2",  "8,5 m", "8 m\n", "8e",    "8 e3 m"};
    for (size_t i = 0; i < COUNT(none); i++)
        bad(none[i], QUANTITY_LENGTH, UNITS_NO_NUMBER);
    for (size_t i = 0; i < COUNT(unknown); i++)
        bad(unknown[i], QUANTITY_LENGTH, UNITS_UNKNOWN);
    bad("8 kg", QUANTITY_LENGTH, UNITS_OF_ANOTHER);
    bad("8 mm^2", QUANTITY_LENGTH, UNITS_OF_ANOTHER);
    bad("8 mm", QUANTITY_STRESS, UNITS_OF_ANOTHER);
    bad("8 mm", QUANTITY_SPEED, UNITS_OF_ANOTHER);
    bad("8 Hz", QUANTITY_TIME, UNITS_OF_ANOTHER);
    bad("8 kh", QUANTITY_TIME, UNITS_UNKNOWN);
    bad("8 N", QUANTITY_STRESS, UNITS_OF_ANOTHER);
    bad("8 g", QUANTITY_DENSITY, UNITS_OF_ANOTHER);
    bad("8 m/s^2", QUANTITY_SPEED, UNITS_OF_ANOTHER);
    bad("8 N/s", QUANTITY_IMPULSE, UNITS_OF_ANOTHER);
    bad("0.3 m", QUANTITY_NUMBER, UNITS_OF_ANOTHER);
    bad("0.3 m/m", QUANTITY_NUMBER, UNITS_OF_ANOTHER);
    /* products of too many, and a number longer than any is */
    bad("8 m m m m m m m m m", QUANTITY_LENGTH, UNITS_UNKNOWN);
    char text[600];
    memset(text, '1', sizeof text);
    strcpy(text + 500, " mm");
    bad(text, QUANTITY_LENGTH, UNITS_NO_NUMBER);
    bad("1e99999999999999999999 mm", QUANTITY_LENGTH, UNITS_NO_NUMBER);
    bits("1e-99999999999999999999 mm", QUANTITY_LENGTH, 0.0);
}

static void test_examples_are_of_their_quantity(void **state)
{
    (void)state;
    for (enum quantity q = QUANTITY_NUMBER; q < QUANTITY_COUNT; q++) {
        char si[40];
        assert_true(good(units_example(q), q) > 0.0);
        snprintf(si, sizeof si, "1.25 %s", units_si(q));
        bits(si, q, 1.25);
    }
}

#ifdef PERCUSS_HAVE_UDUNITS
/* Times what it is in SI by udunits; NAN: it is of something else. Which 1/m is not of m to it
 * either if both are times a kelvin: else it converts by taking the inverse. */
static double theirs(ut_system *system, const char *name, const char *si)
{
    double factor = NAN;
    char text[2][64];
    snprintf(text[0], sizeof text[0], "K.(%s)", name);
    snprintf(text[1], sizeof text[1], "K.(%s)", si);
    ut_unit *from = ut_parse(system, text[0], UT_UTF8), *to = ut_parse(system, text[1], UT_UTF8);
    cv_converter *converter = from && to ? ut_get_converter(from, to) : NULL;
    if (converter) {
        factor = cv_convert_double(converter, 1.0);
        cv_free(converter);
    }
    ut_free(from);
    ut_free(to);
    return factor;
}

/* How udunits calls it. */
static const char *their_name(const char *unit)
{
    return !strcmp(unit, "mi") ? "(mile)" : !strcmp(unit, "mph") ? "(mile/hour)" : unit;
}

/* Every unit with every prefix, in the place of each quantity, alone and in products: what udunits
 * makes of it too, or no such quantity to both. A product is rounded at each factor there, and
 * 2^-52 is half a unit in the last place or one: 1e-14 holds ten of them. */
static void test_udunits_agrees(void **state)
{
    (void)state;
    static const char *const prefixes[] = {"", "n", "u", "m", "c", "d", "k", "M", "G", "T"};
    static const char *const forms[] = {"%s", "1/%s", "g/%s^3", "kg/%s3", "N/%s^2", "N %s-2"};
    ut_set_error_message_handler(ut_ignore);
    ut_system *system = ut_read_xml(NULL);
    assert_non_null(system);
    const char *name;
    int prefixed;
    size_t compared = 0;
    for (size_t i = 0; (name = units_known(i, &prefixed)); i++)
        for (size_t p = 0; p < (prefixed ? COUNT(prefixes) : 1); p++)
            for (size_t f = 0; f < COUNT(forms); f++)
                for (enum quantity q = QUANTITY_LENGTH; q < QUANTITY_COUNT; q++) {
                    char unit[16], product[40], text[48];
                    double value;
                    /* alone it is no gram there */
                    if (q == QUANTITY_ACCELERATION && f == 0 && !strcmp(name, "g"))
                        continue;
                    snprintf(unit, sizeof unit, "%s%s", prefixes[p], name);
                    snprintf(product, sizeof product, forms[f], unit);
                    snprintf(text, sizeof text, "1 %s", product);
                    snprintf(product, sizeof product, forms[f], their_name(unit));
                    double expected = theirs(system, product, units_si(q));
                    enum units_problem problem = units_read(text, q, &value);
                    assert_int_equal(problem, isnan(expected) ? UNITS_OF_ANOTHER : UNITS_GOOD);
                    if (problem)
                        continue;
                    compared++;
                    measured_relative(product, value, expected, 1e-14);
                }
    /* at least each unit and prefix once */
    assert_true(compared > 70);
    ut_free_system(system);
}
#else
static void test_udunits_agrees(void **state)
{
    (void)state;
    print_message("libudunits2 was not there when this was built\n");
    skip();
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_are_those_of_si_to_the_bit),
        cmocka_unit_test(test_thousands_of_millimetres),
        cmocka_unit_test(test_inches_and_pounds),
        cmocka_unit_test(test_what_is_refused),
        cmocka_unit_test(test_examples_are_of_their_quantity),
        cmocka_unit_test(test_udunits_agrees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
