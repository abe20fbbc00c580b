/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests catalogue/catalogue.c: the shipped catalogue, a foreign one, what changes
 * the revision, and that no text whatever does harm. */
#include <locale.h>
#include <math.h>
#include <stdlib.h>

#include "catalogue/names.h"
#include "model/damping.h"
#include "parse.h"

#define SHIPPED PERCUSS_SOURCE_DIR "/config/catalogue.yaml"

static const double pi = 3.14159265358979323846;

static struct body_set *load_shipped(void)
{
    struct body_set *set;
    struct fault fault = {0};
    if (catalogue_load(SHIPPED, &set, &fault))
        fail_msg("%s", fault.text);
    return set;
}

static const struct body *get(const struct body_set *set, const char *id)
{
    const struct body *body = body_set_find(set, id);
    if (!body)
        fail_msg("no body %s", id);
    return body;
}

#define is_read_as(value, expected) near_relative(value, expected, 1e-12)

static void loads_the_shipped_bodies(void **state)
{
    (void)state;
    struct body_set *set = load_shipped();
    assert_int_equal(set->compliance, PERCUSS_COMPLIANCE_MATCHED);

    const struct body *sphere = get(set, "steel-sphere");
    assert_ptr_equal(sphere->kind, &sphere_kind);
    is_read_as(sphere->mass, 4.0 / 3.0 * pi * 0.015 * 0.015 * 0.015 * 7800.0);
    is_read_as(sphere->material.young, 210e9);

    const struct body *rod = get(set, "al-rod");
    is_read_as(rod->mass, pi * 1e-4 * 2700.0);
    assert_true(isinf(rod->tip_radius) && isinf(rod->material.yield));
    is_read_as(get(set, "al-rod-1")->material.yield, 205e6);
    is_read_as(get(set, "al-rod-2")->material.yield, 575e6);

    const struct body *beam = get(set, "al-beam");
    assert_int_equal(beam->theory, THEORY_TIMOSHENKO);
    is_read_as(beam->shear_factor[0],
               6.0 * 1.33 * 1.33 /
                   (7.0 + 12.0 * 0.33 + 4.0 * 0.33 * 0.33)); /* Hutchinson, circle */

    /* bodies of equal mass, to the digits of the file */
    assert_true(fabs(get(set, "al-cylinder")->mass / rod->mass - 1.0) < 1e-8);
    /* the plates' round rims are of parabolas, which takes 5e-6 of the thinner one */
    assert_true(fabs(get(set, "al-half-plate")->mass / rod->mass - 1.0) < 1e-4);
    assert_true(fabs(get(set, "al-half-plate-10")->mass / rod->mass - 1.0) < 1e-4);
    assert_true(isinf(get(set, "steel-wall")->mass));
    is_read_as(get(set, "timoshenko-beam")->mass, 7960.0 * 0.01 * 0.01 * 0.1535);
    assert_int_equal(get(set, "timoshenko-beam")->supports[1], SUPPORT_PINNED);
    assert_null(body_set_find(set, "no-such-body"));
    body_set_free(set);
}

static const char foreign[] =
    "%YAML 1.1\n"
    "---\n"
    "contact:\n"
    "  compliance: matched\n"
    "bodies:\n"
    "  \"brass rod\":\n"
    "    length: 0.4\n"
    "    radius: .006\n"
    "    material: brass\n"
    "    shape: rod\n"
    "    ends: [free, fixed]\n"
    "    lateral_inertia: true\n"
    "    damping: 1.0E-3\n"
    "    modes: 40\n"
    "  marble: {shape: sphere, radius: 8e-3, material: glass}\n"
    "  titan:\n"
    "    shape: beam\n"
    "    material: titanium\n"
    "    section: {width: 0.02, height: 0.005}\n"
    "    length: 0.6\n"
    "    shear_factor: hutchinson\n"
    "    ends: pinned\n"
    "  brick: {shape: block, material: glass, size: [0.1, 0.2, 0.05]}\n"
    "materials:\n"
    "  brass: {young: 100e9, poisson: 0.34, density: 8500, yield: 2e8, tangent: 1e9}\n"
    "  glass: {young: 70e9, poisson: 0.22, density: 2500}\n"
    "  titanium: {young: 114e9, poisson: 0.34, density: 4430}\n";

static void loads_a_foreign_catalogue(void **state)
{
    (void)state;
    struct body_set *set = parse_good(foreign);
    assert_int_equal(set->count, 4);
    assert_int_equal(set->compliance, PERCUSS_COMPLIANCE_MATCHED);

    const struct body *rod = get(set, "brass rod");
    is_read_as(rod->mass, 8500.0 * pi * 0.006 * 0.006 * 0.4);
    assert_int_equal(rod->supports[0], SUPPORT_FREE);
    assert_int_equal(rod->supports[1], SUPPORT_CLAMPED);
    assert_true(rod->lateral_inertia);
    assert_int_equal(rod->modes, 40);
    is_read_as(rod->damping, 1e-3);
    is_read_as(rod->material.tangent, 1e9);
    assert_string_equal(rod->material.name, "brass");

    is_read_as(get(set, "marble")->mass, 2500.0 * 4.0 / 3.0 * pi * 8e-3 * 8e-3 * 8e-3);
    const struct body *beam = get(set, "titan");
    is_read_as(beam->second_moment[0], 0.005 * 0.02 * 0.02 * 0.02 / 12.0);
    is_read_as(beam->second_moment[1], 0.02 * 0.005 * 0.005 * 0.005 / 12.0);
    assert_int_equal(beam->supports[0], SUPPORT_PINNED);
    is_read_as(get(set, "brick")->mass, 2500.0 * 0.1 * 0.2 * 0.05);
    body_set_free(set);
}

/* What a material loses damps what is made of it, unless the body says otherwise; rigid ones have
 * nothing that it could damp. */
static void losses_damp(void **state)
{
    (void)state;
    struct body_set *set = parse_good(
        "materials:\n"
        "  m: {young: 70e9, poisson: 0.3, density: 2700}\n"
        "  nylon: {young: 3e9, poisson: 0.4, density: 1140, loss_factor: 0.06, loss_frequency: 2 "
        "kHz}\n"
        "  ideal: {young: 3e9, poisson: 0.4, density: 1140, loss_factor: 0}\n"
        "bodies:\n"
        "  rod: {shape: rod, material: nylon, radius: 0.01, length: 1}\n"
        "  beam: {shape: beam, material: nylon, radius: 0.01, length: 1, damping: 0.01}\n"
        "  free: {shape: beam, material: nylon, radius: 0.01, length: 1, damping: 0}\n"
        "  ball: {shape: sphere, material: nylon, radius: 0.01}\n"
        "  other: {shape: rod, material: ideal, radius: 0.01, length: 1}\n"
        "  metal: {shape: rod, material: m, radius: 0.01, length: 1}\n");
    is_read_as(get(set, "rod")->damping, 0.03);
    is_read_as(get(set, "rod")->loss_factor, 0.06);
    is_read_as(get(set, "rod")->loss_frequency, 2e3);
    is_read_as(get(set, "beam")->damping, 0.01);
    is_read_as(get(set, "beam")->loss_factor, 0.06);
    is_read_as(get(set, "free")->damping, 0.0);
    is_read_as(get(set, "ball")->damping, 0.0);
    is_read_as(get(set, "ball")->loss_factor, 0.06);
    is_read_as(get(set, "other")->damping, 0.0);
    is_read_as(get(set, "other")->loss_factor, 0.0);
    is_read_as(get(set, "other")->loss_frequency, 0.0);
    is_read_as(get(set, "metal")->damping, 0.0);
    assert_true(isnan(get(set, "metal")->loss_factor));
    body_set_free(set);
}

/* A material that relaxes damps each mode at its frequency; where that is too much it must be said.
 */
static void series_are_read(void **state)
{
    (void)state;
    struct body_set *set =
        parse_good("materials:\n"
                   "  pom: {young: 4 GPa, poisson: 0.4, density: 1410,\n"
                   "        relaxation: [{share: 0.05, time: 2 ms}, {share: 0.1, time: 30 us}]}\n"
                   "  gum: {young: 50 MPa, poisson: 0.49, density: 1100, relaxation: [{share: "
                   "0.98, time: 1}]}\n"
                   "bodies:\n"
                   "  rod: {shape: rod, material: pom, radius: 0.01, length: 1}\n"
                   "  bell: {shape: rod, material: pom, radius: 0.01, length: 1, damping: 0.01}\n"
                   "  ball: {shape: sphere, material: gum, radius: 0.01}\n"
                   "  slug: {shape: rod, material: gum, radius: 0.01, length: 1, damping: 0.5}\n");
    const struct body *rod = get(set, "rod");
    assert_int_equal(rod->relaxation.count, 2);
    is_read_as(rod->relaxation.time[0], 30e-6);
    is_read_as(rod->relaxation.share[0], 0.1);
    is_read_as(rod->relaxation.time[1], 2e-3);
    assert_true(isnan(rod->loss_factor));
    is_read_as(rod->damping, 0.5 * relaxation_peak_loss(&rod->relaxation, 0.0));
    is_read_as(damping_of(rod, 0, 1e4), 0.5 * relaxation_loss_factor(&rod->relaxation, 1e4));
    is_read_as(damping_of(get(set, "bell"), 0, 1e4), 0.01);
    is_read_as(get(set, "ball")->damping, 0.0);
    is_read_as(damping_of(get(set, "slug"), 0, 1.0), 0.5);
    body_set_free(set);
    parse_bad(
        "materials:\n"
        "  gum: {young: 5e7, poisson: 0.49, density: 1100, relaxation: [{share: 0.98, time: 1}]}\n"
        "bodies:\n"
        "  slug: {shape: rod, material: gum, radius: 0.01, length: 1}\n",
        4, "bodies.slug.damping: missing: must be stated, as the loss factor of gum reaches 3.");
}

/* A material that states that it has no yield is as elastic as one that states nothing, which is
 * not known of it. */
static void yields_may_be_none(void **state)
{
    (void)state;
    struct body_set *set =
        parse_good("materials:\n"
                   "  m: {young: 70e9, poisson: 0.3, density: 2700}\n"
                   "  none: {young: 70e9, poisson: 0.3, density: 2700, yield: none, tangent: 0}\n"
                   "  soft: {young: 70e9, poisson: 0.3, density: 2700, yield: 100 MPa}\n"
                   "bodies:\n"
                   "  a: {shape: sphere, material: m, radius: 0.01}\n"
                   "  b: {shape: sphere, material: none, radius: 0.01}\n"
                   "  c: {shape: sphere, material: soft, radius: 0.01}\n");
    assert_true(isinf(get(set, "a")->material.yield) && get(set, "a")->yield_unstated);
    assert_true(isinf(get(set, "b")->material.yield) && !get(set, "b")->yield_unstated);
    assert_true(get(set, "c")->material.yield == 1e8 && !get(set, "c")->yield_unstated);
    body_set_free(set);
}

/* Numbers mean the same where people write a comma (if such a locale is installed). */
static void does_not_depend_on_the_locale(void **state)
{
    (void)state;
    setlocale(LC_ALL, "de_DE.UTF-8");
    struct body_set *set = parse_good(foreign);
    assert_true(get(set, "titan")->length == 0.6);
    body_set_free(set);
    setlocale(LC_ALL, "C");
}

#define BASE_MATERIAL "materials: {m: {young: 70e9, poisson: 0.3, density: 2700}}\n"
#define BASE_A        "  a: {shape: sphere, material: m, radius: 0.01}\n"
#define BASE_B        "  b: {shape: beam, material: m, radius: 0.01, length: 1}\n"

static void revision_of(const char *text, char *revision)
{
    struct body_set *set = parse_good(text);
    strcpy(revision, set->revision);
    assert_int_equal(strlen(revision), 32);
    body_set_free(set);
}

static void keeps_its_revision_when_only_the_look_changes(void **state)
{
    (void)state;
    static const char *const same[] = {
        "# comment\n" BASE_MATERIAL "bodies:\n" BASE_A BASE_B,
        BASE_MATERIAL "bodies:\n" BASE_B BASE_A, /* another order */
        "bodies:\n" BASE_A BASE_B BASE_MATERIAL,
        BASE_MATERIAL "contact: {compliance: matched}\nbodies:\n" BASE_A BASE_B,
        "materials: {m: {young: 7.0e10, poisson: .3, density: 2.7e3, tangent: -0}}\n"
        "bodies:\n  'a':\n    radius: 10e-3\n    shape: sphere\n    material: m\n" BASE_B,
        "materials: {m: {young: 70 GPa, poisson: 0.3, density: 2.7 g/cm^3}}\n" /* with units */
        "bodies:\n  a: {shape: sphere, material: m, radius: 10 mm}\n"
        "  b: {shape: beam, material: m, radius: 1cm, length: 1e3 mm}\n",
        BASE_MATERIAL /* diameters */
        "bodies:\n  a: {shape: sphere, material: m, diameter: 0.02}\n"
        "  b: {shape: beam, material: m, diameter: 20 mm, length: 1, ends: free-free}\n",
        "materials: {n: {young: 1e9, poisson: 0.3, density: 1}, " /* one that nobody uses */
        "m: {young: 70e9, poisson: 0.3, density: 2700}}\nbodies:\n" BASE_A BASE_B,
        BASE_MATERIAL
        "bodies:\n" BASE_A "  b: {shape: beam, material: m, radius: 0.01, length: 1, "
        "theory: timoshenko, shear_factor: hutchinson, ends: [free, free], damping: 0}\n",
    };
    char base[PERCUSS_ID_SIZE], other[PERCUSS_ID_SIZE];
    revision_of(BASE_MATERIAL "bodies:\n" BASE_A BASE_B, base);
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        revision_of(same[i], other);
        assert_string_equal(other, base);
    }
}

/* The ends at -x and +x in one word. */
static void reads_ends_of_two_words(void **state)
{
    (void)state;
    static const struct {
        const char *shape, *word;
        enum support supports[2];
    } cases[] = {
        {"beam", "cantilever", {SUPPORT_CLAMPED, SUPPORT_FREE}},
        {"beam", "clamped-free", {SUPPORT_CLAMPED, SUPPORT_FREE}},
        {"beam", "free-clamped", {SUPPORT_FREE, SUPPORT_CLAMPED}},
        {"beam", "pinned-clamped", {SUPPORT_PINNED, SUPPORT_CLAMPED}},
        {"beam", "pinned-pinned", {SUPPORT_PINNED, SUPPORT_PINNED}},
        {"beam", "[clamped, free]", {SUPPORT_CLAMPED, SUPPORT_FREE}},
        {"rod", "cantilever", {SUPPORT_CLAMPED, SUPPORT_FREE}},
        {"rod", "free-fixed", {SUPPORT_FREE, SUPPORT_CLAMPED}},
        {"block", "cantilever", {SUPPORT_CLAMPED, SUPPORT_FREE}},
        {"block", "free-clamped", {SUPPORT_FREE, SUPPORT_CLAMPED}},
        {"block", "clamped", {SUPPORT_CLAMPED, SUPPORT_CLAMPED}},
        {"block", "[clamped, free]", {SUPPORT_CLAMPED, SUPPORT_FREE}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        bool block = strcmp(cases[i].shape, "block") == 0;
        snprintf(text, sizeof text,
                 BASE_MATERIAL "bodies:\n  b: {shape: %s, material: m, %s, ends: %s}\n",
                 cases[i].shape, block ? "size: [20 mm, 0.1, 0.1]" : "diameter: 20 mm, length: 1",
                 cases[i].word);
        struct body_set *set = parse_good(text);
        assert_int_equal(set->bodies[0].supports[0], cases[i].supports[0]);
        assert_int_equal(set->bodies[0].supports[1], cases[i].supports[1]);
        assert_true(set->bodies[0].radius == (block ? 0.0 : 0.01));
        body_set_free(set);
    }
}

/* Cowper and Symonds's or Johnson and Cook's. */
static void yield_grows_with_the_rate(void **state)
{
    (void)state;
    struct body_set *set =
        parse_good("materials:\n"
                   "  m: {young: 210e9, poisson: 0.3, density: 7800, yield: 250e6}\n"
                   "  mild: {young: 210e9, poisson: 0.3, density: 7800, yield: 250e6, "
                   "rate: {reference: 40.4, exponent: 5}}\n"
                   "  alloy: {young: 210e9, poisson: 0.3, density: 7800, yield: 800e6, "
                   "rate: {coefficient: 0.014, reference: 1}}\n"
                   "bodies:\n"
                   "  one: {shape: sphere, material: m, radius: 0.01}\n"
                   "  two: {shape: sphere, material: mild, radius: 0.01}\n"
                   "  three: {shape: sphere, material: alloy, radius: 0.01}\n");
    assert_false(yield_rate_is_stated(&get(set, "one")->yield_rate));
    is_read_as(yield_rate_factor(&get(set, "two")->yield_rate, 40.4), 2.0);
    is_read_as(yield_rate_factor(&get(set, "three")->yield_rate, exp(5.0)), 1.07);
    body_set_free(set);
    /* each of its numbers makes another catalogue */
    static const char *const rates[] = {
        "", "rate: {reference: 1, exponent: 4}", "rate: {reference: 2, exponent: 4}",
        "rate: {reference: 1, exponent: 5}", "rate: {reference: 1, coefficient: 0.01}"};
    char revisions[COUNT(rates)][PERCUSS_ID_SIZE];
    for (size_t i = 0; i < COUNT(rates); i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "materials: {m: {young: 7e10, poisson: 0.3, density: 2700, yield: 1e8, %s}}\n"
                 "bodies: {r: {shape: sphere, material: m, radius: 0.01}}\n",
                 rates[i]);
        revision_of(text, revisions[i]);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(revisions[i], revisions[k]);
    }
}

static void changes_its_revision_with_the_content(void **state)
{
    (void)state;
    static const char *const rods[] = {
        "  r: {shape: rod, material: m, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: n, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: o, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: p, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: p, radius: 0.01, length: 1, damping: 0}\n",
        "  r: {shape: rod, material: q, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: s, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: t, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: u, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: s, radius: 0.01, length: 1, damping: 0}\n",
        "  r: {shape: rod, material: m, radius: 0.010000000000000002, length: 1}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 2}\n",
        "  R: {shape: rod, material: m, radius: 0.01, length: 1}\n",
        "  r: {shape: cylinder, material: m, radius: 0.01, length: 1}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1, tip_radius: 0.01}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1, lateral_inertia: true}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1, ends: [free, fixed]}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1, ends: [fixed, free]}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1, damping: 0.01}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1, modes: 7}\n",
        "  r: {shape: block, material: m, size: [1, 1, 1]}\n",
        "  r: {shape: block, material: m, size: [1, 1, 1], ends: clamped}\n",
        "  r: {shape: block, material: m, size: [1, 1, 1], ends: cantilever}\n",
        "  r: {shape: block, material: m, size: [1, 1, 1], rigid: true}\n",
        "  r: {shape: beam, material: m, radius: 0.01, length: 1}\n",
        "  r: {shape: beam, material: m, radius: 0.01, length: 1, theory: euler-bernoulli}\n",
        "  r: {shape: beam, material: m, radius: 0.01, length: 1, shear_factor: 0.9}\n",
        "  r: {shape: beam, material: m, section: {width: 0.01, height: 0.02}, length: 1}\n",
        "  r: {shape: beam, material: m, section: {width: 0.02, height: 0.01}, length: 1}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1}\n"
        "contact: {compliance: half-space}\n",
        "  r: {shape: rod, material: m, radius: 0.01, length: 1}\n"
        "  s: {shape: rod, material: m, radius: 0.01, length: 1}\n",
    };
    enum { COUNT = sizeof rods / sizeof *rods };
    char revisions[COUNT][PERCUSS_ID_SIZE];
    for (size_t i = 0; i < COUNT; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "materials: {m: {young: 70e9, poisson: 0.3, density: 2700}, "
                 "n: {young: 70e9, poisson: 0.3, density: 2700, yield: 1e8}, "
                 "o: {young: 70e9, poisson: 0.3, density: 2700, loss_factor: 0}, "
                 "p: {young: 70e9, poisson: 0.3, density: 2700, loss_factor: 0.1}, "
                 "q: {young: 70e9, poisson: 0.3, density: 2700, yield: none}, "
                 "s: {young: 70e9, poisson: 0.3, density: 2700, relaxation: [{share: 0.1, time: "
                 "1}]}, "
                 "t: {young: 70e9, poisson: 0.3, density: 2700, relaxation: [{share: 0.1, time: "
                 "2}]}, "
                 "u: {young: 70e9, poisson: 0.3, density: 2700, loss_factor: 0.1, loss_frequency: "
                 "1}}\nbodies:\n%s",
                 rods[i]);
        revision_of(text, revisions[i]);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(revisions[i], revisions[k]);
    }
}

#define PAIRED                                                                                     \
    "materials:\n"                                                                                 \
    "  steel: {young: 210e9, poisson: 0.3, density: 7800}\n"                                       \
    "  glass: {young: 48e9, poisson: 0.2, density: 2800}\n"                                        \
    "  lead:  {young: 16e9, poisson: 0.44, density: 11340}\n"                                      \
    "bodies:\n"                                                                                    \
    "  s: {shape: sphere, material: steel, radius: 0.01}\n"                                        \
    "  g: {shape: sphere, material: glass, radius: 0.01}\n"                                        \
    "  l: {shape: sphere, material: lead, radius: 0.01}\n"

static const struct friction_pair *between(const struct body_set *set, const char *a, const char *b)
{
    const struct friction_pair *pair =
        body_set_friction(set, &body_set_find(set, a)->material, &body_set_find(set, b)->material);
    assert_ptr_equal(pair, body_set_friction(set, &body_set_find(set, b)->material,
                                             &body_set_find(set, a)->material));
    return pair;
}

/* By the materials' names, in either order, and whatever parameters a request varies. */
static void finds_the_friction_of_two_materials(void **state)
{
    (void)state;
    struct body_set *set =
        parse_good("friction:\n- {between: [steel, glass], coefficient: 0.2}\n"
                   "- {between: [lead, lead], coefficient: 10, deviation: 0}\n"
                   "- {between: [glass, glass], coefficient: 0.092, deviation: 0.006}\n" PAIRED);
    assert_int_equal(set->friction_count, 3);
    assert_true(between(set, "s", "g")->coefficient == 0.2);
    near(between(set, "s", "g")->deviation, 0.04, 1e-17);
    assert_true(between(set, "g", "g")->coefficient == 0.092);
    assert_true(between(set, "g", "g")->deviation == 0.006);
    assert_true(between(set, "l", "l")->coefficient == 10.0);
    assert_true(between(set, "l", "l")->deviation == 0.0);
    assert_null(between(set, "s", "s"));
    assert_null(between(set, "s", "l"));
    assert_null(between(set, "g", "l"));
    struct body varied;
    const struct body_variation softer = {PERCUSS_PARAMETER_YOUNG, 2e11};
    assert_int_equal(body_vary(body_set_find(set, "s"), &softer, 1, &varied, NULL), PERCUSS_OK);
    assert_ptr_equal(body_set_friction(set, &varied.material, &body_set_find(set, "g")->material),
                     between(set, "s", "g"));
    /* a material that no catalogue names */
    const struct material own = {"", 210e9, 0.3, 7800.0, INFINITY, 0.0};
    assert_null(body_set_friction(set, &own, &own));
    body_set_free(set);
    set = parse_good(PAIRED "friction: []\n");
    assert_null(between(set, "s", "g"));
    body_set_free(set);
}

/* Every pair of many materials. */
static void finds_each_of_many_pairs(void **state)
{
    (void)state;
    enum { MATERIALS = 40 };
    size_t room = 256 * 1024, length = 0;
    char *text = malloc(room);
    assert_non_null(text);
    length += (size_t)snprintf(text, room,
                               "bodies: {s: {shape: half-space, material: m0}}\nmaterials:\n");
    for (int i = 0; i < MATERIALS; i++)
        length += (size_t)snprintf(text + length, room - length,
                                   "  m%d: {young: 1e9, poisson: 0.3, density: 1000}\n", i);
    length += (size_t)snprintf(text + length, room - length, "friction:\n");
    for (int i = 0; i < MATERIALS; i++)
        for (int j = 0; j <= i; j++)
            length += (size_t)snprintf(text + length, room - length,
                                       "- {between: [m%d, m%d], coefficient: 0.%02d%02d}\n",
                                       i % 2 ? i : j, i % 2 ? j : i, i, j);
    struct body_set *set = parse_good(text);
    free(text);
    for (int i = 0; i < MATERIALS; i++)
        for (int j = 0; j <= i; j++) {
            struct material a = {.young = 1.0}, b = {.young = 1.0};
            snprintf(a.name, sizeof a.name, "m%d", i);
            snprintf(b.name, sizeof b.name, "m%d", j);
            const struct friction_pair *pair = body_set_friction(set, &a, &b);
            assert_non_null(pair);
            near(pair->coefficient, 0.01 * i + 0.0001 * j, 1e-15);
            assert_ptr_equal(body_set_friction(set, &b, &a), pair);
        }
    body_set_free(set);
}

/* The revision is what it was without the key; it depends on the pairs, not on how they are
 * written. */
static void friction_belongs_to_the_revision(void **state)
{
    (void)state;
    static const char *const same[] = {
        "friction: [{between: [steel, glass], coefficient: 0.2}, "
        "{between: [lead, lead], coefficient: 1}]\n",
        "friction:\n- {coefficient: 1.0, between: [lead, lead], deviation: 0.2}\n"
        "- {between: [glass, steel], coefficient: 2e-1}\n",
    };
    static const char *const others[] = {
        "friction: [{between: [steel, glass], coefficient: 0.2}]\n",
        "friction: [{between: [steel, glass], coefficient: 0.3}]\n",
        "friction: [{between: [steel, glass], coefficient: 0.2, deviation: 0.05}]\n",
        "friction: [{between: [steel, lead], coefficient: 0.2}]\n",
        "friction: [{between: [steel, steel], coefficient: 0.2}]\n",
        "friction: [{between: [steel, steel], coefficient: 0}]\n",
    };
    char text[2048], plain[PERCUSS_ID_SIZE], first[PERCUSS_ID_SIZE], other[PERCUSS_ID_SIZE];
    char seen[COUNT(others)][PERCUSS_ID_SIZE];
    revision_of(PAIRED, plain);
    assert_string_equal(plain, "239e694d0baf2282fa901d6e04024cd2");
    revision_of("friction: []\n" PAIRED, other);
    assert_string_equal(other, plain);
    for (size_t i = 0; i < COUNT(same); i++) {
        snprintf(text, sizeof text, "%s%s", PAIRED, same[i]);
        revision_of(text, i == 0 ? first : other);
    }
    assert_string_equal(other, first);
    assert_string_not_equal(first, plain);
    for (size_t i = 0; i < COUNT(others); i++) {
        snprintf(text, sizeof text, "%s%s", PAIRED, others[i]);
        revision_of(text, seen[i]);
        assert_string_not_equal(seen[i], plain);
        assert_string_not_equal(seen[i], first);
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(seen[i], seen[k]);
    }
}

static void says_why_a_file_cannot_be_read(void **state)
{
    (void)state;
    struct body_set *set;
    struct fault fault;
    assert_int_equal(catalogue_load("/no/such/file.yaml", &set, &fault), PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text,
                        "/no/such/file.yaml: cannot be read: No such file or directory");
    assert_int_equal(catalogue_load("/", &set, &fault), PERCUSS_BAD_REQUEST);
    assert_int_equal(catalogue_load("/dev/null", &set, &fault), PERCUSS_BAD_REQUEST);
    assert_int_equal(catalogue_load("/dev/zero", &set, &fault), PERCUSS_BAD_REQUEST);
    assert_null(set);
}

/* 100000 bodies: ids are compared by sorting, not each with each. */
static void loads_many_bodies(void **state)
{
    (void)state;
    size_t size = 100 * (size_t)NAMES_MOST, length = 0;
    char *text = malloc(size);
    assert_non_null(text);
    length += (size_t)snprintf(text, size, BASE_MATERIAL "bodies:\n");
    for (int i = 0; i < NAMES_MOST; i++)
        length += (size_t)snprintf(text + length, size - length,
                                   "  s%d: {shape: sphere, material: m, radius: 0.01}\n", i);
    struct body_set *set = parse_good(text);
    assert_int_equal(set->count, NAMES_MOST);
    body_set_free(set);
    snprintf(text + length, size - length, "  more: {shape: half-space, material: m}\n");
    parse_bad(text, 3, "bodies: 100001 entries: must be 1 to 100000");
    free(text);
}

static uint64_t next_random(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15; /* splitmix64 */
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

/* Flips, deletes or inserts a byte; the buffer has room for one more. */
static size_t mutate(char *text, size_t size, uint64_t *random)
{
    static const char favourites[] = "{}[]:,-?&*!|>'\"%@`# \n\t\r0e.+-\0\x7F\x80\xC2\xFF";
    size_t at = next_random(random) % (size - 1);
    uint64_t kind = next_random(random);
    char byte = kind & 8 ? (char)(kind >> 8) : favourites[(kind >> 8) % (sizeof favourites - 1)];
    if (kind % 3 == 0) {
        text[at] = byte;
        return size;
    }
    if (kind % 3 == 1) {
        memmove(text + at, text + at + 1, size - at - 1);
        return size - 1;
    }
    memmove(text + at + 1, text + at, size - at);
    text[at] = byte;
    return size + 1;
}

static size_t read_shipped(char *text, size_t room)
{
    FILE *file = fopen(SHIPPED, "rb");
    assert_non_null(file);
    size_t size = fread(text, 1, room, file);
    fclose(file);
    assert_in_range(size, 1000, room - 1);
    return size;
}

/* Without the bodies that have files, which would be read each time. */
static size_t leave_meshes_out(char *text, size_t size)
{
    static const char mark[] = "shape: mesh";
    char *found;
    text[size] = '\0';
    while ((found = strstr(text, mark))) {
        char *end = strchr(found, '\n') + 1;
        while (found > text && found[-1] != '\n')
            found--;
        memmove(found, end, strlen(end) + 1);
    }
    return strlen(text);
}

/* 20000 damaged catalogues, 1 to 8 bytes each: an answer or a message, and every body finite. */
static void survives_damaged_files(void **state)
{
    (void)state;
    enum { ROOM = 16384, CHANGES = 8 };
    static char shipped[ROOM], text[ROOM + CHANGES];
    size_t shipped_size = leave_meshes_out(shipped, read_shipped(shipped, ROOM)), good = 0;
    uint64_t random = 1;
    for (int i = 0; i < 20000; i++) {
        size_t size = shipped_size;
        memcpy(text, shipped, size);
        for (uint64_t n = 1 + next_random(&random) % CHANGES; n > 0; n--)
            size = mutate(text, size, &random);
        /* a copy of exactly this size lets a sanitizer see any byte read beyond it */
        char *exact = malloc(size);
        struct body_set *set;
        struct fault fault = {0};
        assert_non_null(exact);
        memcpy(exact, text, size);
        enum percuss_status status = catalogue_parse(exact, size, "damaged", &set, &fault);
        free(exact);
        assert_true(status == PERCUSS_OK || status == PERCUSS_BAD_REQUEST);
        assert_true((status == PERCUSS_OK) == (set != NULL));
        assert_true((status == PERCUSS_OK) == (fault.text[0] == '\0'));
        for (size_t k = 0; set && k < set->count; k++)
            assert_true(set->bodies[k].mass > 0.0 && body_smallest_radius(&set->bodies[k]) > 0.0);
        good += set != NULL;
        body_set_free(set);
    }
    assert_true(good > 100); /* comments and blanks: both outcomes are exercised */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_the_shipped_bodies),
        cmocka_unit_test(loads_a_foreign_catalogue),
        cmocka_unit_test(losses_damp),
        cmocka_unit_test(series_are_read),
        cmocka_unit_test(yield_grows_with_the_rate),
        cmocka_unit_test(yields_may_be_none),
        cmocka_unit_test(does_not_depend_on_the_locale),
        cmocka_unit_test(keeps_its_revision_when_only_the_look_changes),
        cmocka_unit_test(reads_ends_of_two_words),
        cmocka_unit_test(changes_its_revision_with_the_content),
        cmocka_unit_test(finds_the_friction_of_two_materials),
        cmocka_unit_test(finds_each_of_many_pairs),
        cmocka_unit_test(friction_belongs_to_the_revision),
        cmocka_unit_test(says_why_a_file_cannot_be_read),
        cmocka_unit_test(loads_many_bodies),
        cmocka_unit_test(survives_damaged_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
