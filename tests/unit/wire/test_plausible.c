/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests idl/percuss/plausible.h. */
#include "check.h"
#include "percuss/plausible.h"

static struct plausible_remark remarks[PLAUSIBLE_MOST];

static size_t material(double young, double density, double yield)
{
    static const double none[3] = {0.0};
    return plausible_material(&(struct plausible_body){"sphere", young, density, yield, none},
                              remarks);
}

static size_t size(const char *shape, double x, double y, double z)
{
    const double half[] = {0.5 * x, 0.5 * y, 0.5 * z};
    return plausible_size(&(struct plausible_body){shape, NAN, NAN, NAN, half}, remarks);
}

/* Handbook values of what is hit, from soft to hard and from light to heavy; and the bounds. */
static void test_materials_that_there_are(void **state)
{
    (void)state;
    assert_int_equal(material(210e9, 7800.0, INFINITY), 0);
    assert_int_equal(material(70e9, 2700.0, 205e6), 0);
    assert_int_equal(material(16e9, 11340.0, 5e6), 0);       /* lead */
    assert_int_equal(material(2e6, 1100.0, INFINITY), 0);    /* soft rubber */
    assert_int_equal(material(3e9, 120.0, INFINITY), 0);     /* balsa along the grain */
    assert_int_equal(material(1.2e12, 3515.0, INFINITY), 0); /* diamond */
    assert_int_equal(material(560e9, 22590.0, INFINITY), 0); /* osmium */
    assert_int_equal(material(1e6, 100.0, 1e5), 0);
    assert_int_equal(material(1.2e12, 25000.0, 2e10), 0);
    assert_int_equal(material(45e9, 1740.0, 150e6), 0);      /* magnesium */
    assert_int_equal(material(0.4e9, 2200.0, INFINITY), 0);  /* PTFE, a polymer by its density */
    assert_int_equal(material(0.01e9, 1500.0, INFINITY), 0); /* rubber with much filler */
    /* a mesh of several materials has no numbers of its own */
    assert_int_equal(material(NAN, NAN, NAN), 0);
}

static void test_materials_in_another_unit(void **state)
{
    (void)state;
    assert_int_equal(material(210e9, 7.8, INFINITY), 1);
    assert_string_equal(remarks[0].key, "density");
    assert_string_equal(remarks[0].text,
                        "7.8 kg/m^3: below 100 kg/m^3: is a unit missing, such as g/cm^3?");
    assert_int_equal(material(210e3, 7800.0, INFINITY), 1);
    assert_string_equal(remarks[0].key, "young");
    /* GPa typed as MPa, and the other way */
    assert_int_equal(material(210e6, 7800.0, INFINITY), 1);
    assert_string_equal(
        remarks[0].text,
        "2.1e+08 Pa: below 1e+09 Pa: softer than what has this density: is GPa meant?");
    assert_int_equal(material(70e6, 2700.0, INFINITY), 1);
    assert_int_equal(material(45e6, 1740.0, INFINITY), 1);
    assert_int_equal(material(16e6, 11340.0, 5e6), 1);
    assert_int_equal(material(2.1e12, 7800.0, INFINITY), 1);
    assert_string_equal(remarks[0].text,
                        "2.1e+12 Pa: above 1.2e+12 Pa: no solid is as stiff: is GPa meant?");
    /* a polymer in kPa */
    assert_int_equal(material(3e5, 1200.0, INFINITY), 1);
    assert_int_equal(material(210.0, 7.8, 205.0), 3);
    assert_string_equal(remarks[2].key, "yield");
    assert_int_equal(material(210e12, 7.8e4, 205e9), 3);
}

static bool unstated(double young, double density, double yield, bool none)
{
    static const double extents[3] = {0.0};
    const struct plausible_body body = {"sphere", young, density, yield, extents};
    return plausible_unstated(&body, none, remarks);
}

/* Metals of which nothing is said; no plastics, woods and carbon fibres, and no mesh of several. */
static void test_yields_that_are_not_stated(void **state)
{
    (void)state;
    assert_true(unstated(210e9, 7800.0, INFINITY, false));
    assert_string_equal(remarks[0].key, "yield");
    assert_string_equal(remarks[0].text,
                        "not stated: it stays elastic in every contact; a metal yields (mostly at "
                        "210 to 2100 MPa): state yield, or none");
    assert_false(unstated(210e9, 7800.0, INFINITY, true) || unstated(210e9, 7800.0, 4e8, false));
    assert_true(unstated(16e9, 11340.0, INFINITY, false));   /* lead */
    assert_true(unstated(45e9, 1740.0, INFINITY, false));    /* magnesium */
    assert_true(unstated(560e9, 22590.0, INFINITY, false));  /* osmium */
    assert_false(unstated(3e9, 1140.0, INFINITY, false));    /* nylon */
    assert_false(unstated(4e9, 1800.0, INFINITY, false));    /* filled plastics */
    assert_false(unstated(12e9, 700.0, INFINITY, false));    /* oak */
    assert_false(unstated(140e9, 1600.0, INFINITY, false));  /* carbon fibres */
    assert_false(unstated(1.2e12, 3515.0, INFINITY, false)); /* diamond */
    assert_false(unstated(NAN, NAN, INFINITY, false) || unstated(70e9, 2700.0, NAN, false));
}

static bool lossless(double young, bool stated)
{
    static const double extents[3] = {0.0};
    const struct plausible_body body = {"sphere", young, 1200.0, INFINITY, extents};
    return plausible_lossless(&body, stated, remarks);
}

/* Plastics and rubber; no metals, no mesh of several. */
static void test_losses_that_are_not_stated(void **state)
{
    (void)state;
    assert_true(lossless(5e6, false));
    assert_string_equal(remarks[0].key, "loss_factor");
    assert_string_equal(remarks[0].text,
                        "not stated: its contacts lose nothing by it; hard plastics have 0.02 to "
                        "0.1, rubber 0.05 to 1: state loss_factor, or 0");
    assert_true(lossless(3e9, false));
    assert_false(lossless(1e5, false)); /* Pa for MPa */
    assert_false(lossless(3e9, true) || lossless(16e9, false) || lossless(NAN, false));
}

static void test_sizes(void **state)
{
    (void)state;
    /* the paper's bodies */
    assert_int_equal(size("rod", 1.0, 0.02, 0.02), 0);
    assert_int_equal(size("sphere", 0.03, 0.03, 0.03), 0);
    assert_int_equal(size("half-space", 0.0, 0.0, 0.0), 0);
    /* up to the bounds, and beyond; the shorter side of a section is its thickness */
    assert_int_equal(size("rod", 0.04, 0.02, 0.02), 0);
    assert_int_equal(size("rod", 0.039, 0.02, 0.02), 1);
    assert_string_equal(remarks[0].key, "length");
    assert_int_equal(size("cylinder", 0.01, 0.02, 0.02), 0);
    assert_int_equal(size("beam", 1.0, 0.3, 0.002), 0);
    assert_int_equal(size("beam", 1.0, 0.3, 0.0019), 1);
    assert_int_equal(size("rod", 101.0, 0.5, 0.5), 1);
    assert_int_equal(size("sphere", 2.0, 2.0, 2.0), 0);
    assert_int_equal(size("sphere", 16.0, 16.0, 16.0), 1);
    assert_string_equal(remarks[0].text, "16 m: more than 2 m: is a unit missing, such as mm?");
    assert_int_equal(size("block", 0.1, 0.1, 1e-5), 1);
    /* all at once are fewer than there is room for */
    assert_true(size("beam", 101.0, 60.0, 1e-5) < PLAUSIBLE_MOST);
    /* percuss-reduce has looked at a mesh */
    assert_int_equal(size("mesh", 16.0, 16.0, 1e-5), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_materials_that_there_are),
        cmocka_unit_test(test_materials_in_another_unit),
        cmocka_unit_test(test_yields_that_are_not_stated),
        cmocka_unit_test(test_losses_that_are_not_stated),
        cmocka_unit_test(test_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
