/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests catalogue/keys.c, reader.c, names.c and catalogue.c: every kind of error in a well-formed
 * document, with its line and what is allowed. */
#include "parse.h"

#define MATERIALS                                                                                  \
    "materials:\n"                                                                                 \
    "  steel: {young: 210e9, poisson: 0.3, density: 7800}\n"                                       \
    "  glass: {young: 48e9, poisson: 0.2, density: 2800}\n"                                        \
    "bodies:\n"

struct bad {
    const char *text; /* of a body, on line 5 */
    const char *fragment;
};

static void refuse_bodies(const struct bad *bad, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char text[1024];
        snprintf(text, sizeof text, MATERIALS "%s\n", bad[i].text);
        parse_bad(text, 5, bad[i].fragment);
    }
}
#define REFUSE(array) refuse_bodies(array, sizeof array / sizeof *array)

static void refuses_impossible_sizes(void **state)
{
    (void)state;
    static const struct bad bad[] = {
        {"  s: {shape: sphere, material: steel, radius: -0.01}",
         "bodies.s.radius: -0.01: must be a finite length > 0 m"},
        {"  s: {shape: sphere, material: steel, radius: 0}", "radius: 0: must be"},
        {"  s: {shape: sphere, material: steel, radius: 1e4}", "1e-9 to 1e3 m"},
        {"  s: {shape: sphere, material: steel, radius: 1e-300}", "bodies.s.radius: 1e-300"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 0}", "bodies.r.length: 0"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, tip_radius: 0.005}",
         "bodies.r.tip_radius: 0.005: must be at least radius (0.01 m)"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 0.015, tip_radius: 0.01}",
         "bodies.b.length: 0.015: must be at least 0.02 m, the height of both caps of tip_radius "
         "0.01 m"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, tip_radius: 0.005}",
         "bodies.b.tip_radius: 0.005: must be at least radius (0.01 m)"},
        {"  b: {shape: beam, material: steel, section: {width: 0.01, height: 0.01}, length: 1, "
         "tip_radius: 0.02}",
         "bodies.b.tip_radius: 0.02: must be absent beside section: caps are of a round one"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, damping: 1}",
         "bodies.r.damping: 1: must be a ratio >= 0 and < 1"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, damping: [0.1, 0.2]}",
         "must be a ratio >= 0 and < 1"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, modes: 5001}",
         "bodies.r.modes: 5001: must be a whole number, 1 to 5000"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, modes: 0}", "modes: 0: must"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, modes: 2.5}", "modes: 2.5"},
        {"  b: {shape: beam, material: steel, section: {width: 0.1, height: 0}, length: 1}",
         "bodies.b.section.height: 0: must be a finite length"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, shear_factor: 0}",
         "bodies.b.shear_factor: 0: must be cowper, hutchinson or a number > 0"},
        {"  k: {shape: block, material: steel, size: [1, -1, 1]}",
         "bodies.k.size[1]: -1: must be a finite length"},
    };
    REFUSE(bad);
}

static void refuses_what_is_no_number(void **state)
{
    (void)state;
    static const char *const values[] = {
        "big", "'0.01'", "'8 mm'", ".inf", ".nan", "inf",   "nan",  "+",   ".",  "~",
        "m",   "null",   "",       "[1]",  "{}",   "1e999", "true", "--1", "e5", "\"1\"",
    };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 MATERIALS "  s:\n    shape: sphere\n    material: steel\n    radius: %s\n",
                 values[i]);
        parse_bad(text, 8, "bodies.s.radius: ");
        parse_bad(text, 8, "must be a finite length > 0 m");
    }
}

static void refuses_what_is_no_unit(void **state)
{
    (void)state;
    static const char *const values[] = {"8 kg", "8 mm^2", "8 furlong", "0x1p-3",
                                         "1_0",  "1:30",   "0.01.0.01", "1e5.0",
                                         "1e",   "1e+",    "1,5",       "8 M"};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[512], start[80];
        snprintf(text, sizeof text,
                 MATERIALS "  s:\n    shape: sphere\n    material: steel\n    radius: %s\n",
                 values[i]);
        snprintf(start, sizeof start, "bodies.s.radius: %s: must be a length, such as 8 mm; ",
                 values[i]);
        parse_bad(text, 8, start);
    }
    static const struct bad bad[] = {
        {"  s: {shape: sphere, material: steel, radius: 8 kg}", "; kg is no length"},
        {"  s: {shape: sphere, material: steel, radius: 8furlong}",
         "; furlong is no unit that is known"},
        {"  s: {shape: sphere, material: steel, radius: 2 km}",
         "2 km: must be a finite length > 0 m"},
        {"  k: {shape: block, material: steel, size: [1 m, 1 s, 1 m]}",
         "bodies.k.size[1]: 1 s: must be a length, such as 8 mm; s is no length"},
        {"  r: {shape: rod, material: steel, radius: 1 cm, length: 1, damping: 0.1 m}",
         "bodies.r.damping: 0.1 m: must be a ratio >= 0 and < 1"},
        {"  r: {shape: rod, material: steel, radius: 1 cm, length: 1, modes: 5 m}",
         "bodies.r.modes: 5 m: must be a whole number"},
    };
    REFUSE(bad);
}

static void accepts_decimal_numbers(void **state)
{
    (void)state;
    static const char *const values[] = {"0.25", ".25", "+0.25", "25e-2", "2.5E-1", "0.0025e+2"};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[512];
        snprintf(text, sizeof text, MATERIALS "  s: {shape: sphere, material: steel, radius: %s}\n",
                 values[i]);
        struct body_set *set = parse_good(text);
        assert_true(set->bodies[0].radius == 0.25);
        body_set_free(set);
    }
}

static void refuses_unknown_words(void **state)
{
    (void)state;
    static const struct bad bad[] = {
        {"  s: {shape: ball, material: steel, radius: 1}",
         "bodies.s.shape: ball: must be one of sphere, rod, beam, cylinder, block, half-space"},
        {"  s: {shape: sphere, material: wood, radius: 1}",
         "bodies.s.material: wood: unknown material; must be one of glass, steel"},
        {"  s: {shape: sphere, material: [steel], radius: 1}", "bodies.s.material: a list"},
        {"  s: {shape: sphere, material: steel, radius: 1, colour: red}",
         "bodies.s: colour: unknown key; the keys of sphere are shape, material, radius, diameter"},
        {"  s: {shape: sphere, material: steel, radius: 1, damping: 0.1}",
         "damping: unknown key; the keys of sphere are"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, tips: 1}",
         "tips: unknown key; the keys of beam are shape, material, radius, diameter, section, "
         "length, tip_radius, theory, shear_factor, ends, damping, modes"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, ends: loose}",
         "bodies.b.ends: loose: must be one of free, pinned, clamped, or two of them, at -x and at "
         "+x: [clamped, free], also written clamped-free or cantilever"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, ends: clamped-free}",
         "bodies.r.ends: clamped-free: must be one of free, fixed, or two of them, at -x and at "
         "+x: [fixed, free], also written fixed-free or cantilever"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, ends: clamped-}",
         "bodies.b.ends: clamped-: must be one of"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, ends: [cantilever, free]}",
         "bodies.b.ends[0]: cantilever: must be one of free, pinned, clamped"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, ends: [free]}",
         "bodies.b.ends: a list: must be"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, ends: [free, fixed]}",
         "bodies.b.ends[1]: fixed: must be one of free, pinned, clamped"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, ends: pinned}",
         "bodies.r.ends: pinned: must be one of free, fixed"},
        {"  k: {shape: block, material: steel, size: [0.1, 0.1, 0.1], ends: pinned-free}",
         "bodies.k.ends: pinned-free: must be one of free, clamped, or two of them"},
        {"  k: {shape: block, material: steel, size: [0.1, 0.1, 0.1], ends: [pinned, free]}",
         "the end of a block has no pin: clamp it, or use a beam"},
        {"  k: {shape: block, material: steel, size: [0.1, 0.1, 0.1], ends: clamped, rigid: true}",
         "rigid: true: must be false where an end is held"},
        {"  c: {shape: cylinder, material: steel, radius: 0.1, length: 0.1, ends: clamped}",
         "ends: unknown key"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, theory: rayleigh}",
         "bodies.b.theory: rayleigh: must be one of timoshenko, euler-bernoulli"},
        {"  b: {shape: beam, material: steel, radius: 0.01, length: 1, shear_factor: best}",
         "bodies.b.shear_factor: best: must be cowper, hutchinson or a number"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, lateral_inertia: yes}",
         "bodies.r.lateral_inertia: yes: must be true or false"},
        {"  r: {shape: rod, material: steel, radius: 0.01, length: 1, lateral_inertia: 'true'}",
         "must be true or false"},
    };
    REFUSE(bad);
}

static void refuses_missing_and_double_keys(void **state)
{
    (void)state;
    static const struct bad bad[] = {
        {"  s: {material: steel, radius: 1}", "bodies.s.shape: missing: must be one of sphere"},
        {"  s:\n    shape: sphere\n    radius: 1", "bodies.s.material: missing"},
        {"  s: {shape: sphere, material: steel}",
         "bodies.s: radius or diameter missing: a sphere must have one of them"},
        {"  s: {shape: sphere, material: steel, radius: 1, diameter: 2}",
         "bodies.s.diameter: must be absent beside radius"},
        {"  c: {shape: cylinder, material: steel, diameter: 2, length: 1, radius: 1}",
         "bodies.c.diameter: must be absent beside radius"},
        {"  r: {shape: rod, material: steel, diameter: -2 mm, length: 1}",
         "bodies.r.diameter: -2 mm: must be a finite length > 0 m"},
        {"  b: {shape: beam, material: steel, length: 1}",
         "bodies.b: radius, diameter or section missing: a beam must have one of them"},
        {"  b: {shape: beam, material: steel, diameter: 1, section: {width: 1, height: 1}, length: "
         "1}",
         "bodies.b.section: must be absent beside diameter"},
        {"  b: {shape: beam, material: steel, radius: 0.01}", "bodies.b.length: missing"},
        {"  b: {shape: beam, material: steel, section: {width: 1}, length: 1}",
         "bodies.b.section.height: missing"},
        {"  b: {shape: beam, material: steel, radius: 1, section: {width: 1, height: 1}, length: "
         "1}",
         "bodies.b.section: must be absent beside radius"},
        {"  b: {shape: beam, material: steel, section: 0.1, length: 1}",
         "bodies.b.section: 0.1: must be a mapping of width, height"},
        {"  k: {shape: block, material: steel, size: [1, 1]}",
         "bodies.k.size: a list: must be a list of three"},
        {"  k: {shape: block, material: steel, size: 1}", "bodies.k.size: 1: must be a list"},
        {"  s: {shape: sphere, material: steel, radius: 1, radius: 2}",
         "bodies.s.radius: must stand once, but is on line 5 already"},
        {"  s: 1", "bodies.s: 1: must be a mapping with shape, material"},
        {"  s:", "bodies.s: nothing: must be a mapping"},
        {"  s: {? [1, 2] : 3, shape: sphere}", "bodies.s: a list: unknown key"},
    };
    REFUSE(bad);
    parse_bad(MATERIALS "  s: {shape: half-space, material: steel}\n\n"
                        "  s: {shape: half-space, material: glass}\n",
              7, "bodies: s: must stand once, but is on line 5 already");
}

static void refuses_bad_ids(void **state)
{
    (void)state;
#define TEN   "0123456789"
#define SIXTY TEN TEN TEN TEN TEN TEN
    static const struct bad bad[] = {
        {"  " SIXTY "1234: {shape: half-space, material: steel}", "word of 1 to 63 bytes"},
        {"  '': {shape: half-space, material: steel}", "bodies: nothing: an id must be"},
        {"  \"a\\nb\": {shape: half-space, material: steel}", "a?b: an id must be"},
        {"  \"a\\0b\": {shape: half-space, material: steel}", "a?b: an id must be"},
        {"  \"a\\u0085b\": {shape: half-space, material: steel}", "without control characters"},
        {"  [a, b]: {shape: half-space, material: steel}", "a list: an id must be"},
    };
    REFUSE(bad);
    struct body_set *set = parse_good(MATERIALS "  " SIXTY "123: {shape: half-space, material: "
                                                "steel}\n  Kügelchen 1: {shape: half-space, "
                                                "material: glass}\n");
    assert_non_null(body_set_find(set, SIXTY "123"));
    assert_non_null(body_set_find(set, "Kügelchen 1"));
    body_set_free(set);
}

#define RELAXES "young: 1e9, poisson: 0.3, density: 1, relaxation: "
#define THREE   "{share: 0.1, time: 1}, {share: 0.1, time: 2}, {share: 0.1, time: 3}"
#define NINE    THREE ", " THREE ", " THREE

static void parse_bad_materials(const struct bad *bad, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char text[512];
        snprintf(text, sizeof text, "materials:\n  m: {%s}\nbodies:\n  w: {shape: half-space}\n",
                 bad[i].text);
        parse_bad(text, 2, bad[i].fragment);
    }
}

static void refuses_bad_rates(void **state)
{
    (void)state;
    static const struct bad bad[] = {
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, rate: 40",
         "materials.m.rate: 40: must be a mapping of reference, exponent, coefficient"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, rate: {exponent: 5}",
         "materials.m.rate.reference: missing: must be a finite rate"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, rate: {reference: 40}",
         "materials.m.rate: exponent or coefficient missing: a rate must have one of them"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, "
         "rate: {reference: 40, exponent: 5, coefficient: 0.01}",
         "materials.m.rate.coefficient: must be absent beside exponent"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, rate: {reference: 0, exponent: 5}",
         "materials.m.rate.reference: 0: must be a finite rate > 0 1/s"},
        /* one for the other */
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, rate: {reference: 1, exponent: 0.014}",
         "materials.m.rate.exponent: 0.014: must be a number, 1 to 100"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, rate: {reference: 1, coefficient: 5}",
         "materials.m.rate.coefficient: 5: must be a number > 0 and < 1"},
        {"young: 1e9, poisson: 0.3, density: 1, rate: {reference: 40, exponent: 5}",
         "materials.m.rate: must be absent without yield"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: none, rate: {reference: 40, exponent: 5}",
         "materials.m.rate: must be absent without yield"},
    };
    parse_bad_materials(bad, COUNT(bad));
}

static void refuses_bad_materials(void **state)
{
    (void)state;
    static const struct bad bad[] = {
        {"young: 0, poisson: 0.3, density: 1", "materials.m.young: 0: must be a finite modulus"},
        {"young: 210, poisson: 0.3, density: 7800", "materials.m.young: 210: must be"},
        {"young: 1e9, poisson: 0.5, density: 1", "materials.m.poisson: 0.5: must be a number > -1"},
        {"young: 1e9, poisson: -1, density: 1", "materials.m.poisson: -1: must be"},
        {"young: 1e9, poisson: 0.3, density: 0", "materials.m.density: 0: must be a finite"},
        {"young: 1e9, poisson: 0.3", "materials.m.density: missing: must be"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 0",
         "materials.m.yield: 0: must be none or a finite stress > 0 Pa"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: nothing", "yield: nothing: must be none or"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: none, tangent: 1e6",
         "must be 0 or absent without yield"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e9", "yield: 1e+09: must be below young"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, tangent: -1", "tangent: -1: must be"},
        {"young: 1e9, poisson: 0.3, density: 1, yield: 1e6, tangent: 1e9",
         "materials.m.tangent: 1e+09: must be below young"},
        {"young: 1e9, poisson: 0.3, density: 1, tangent: 1e6", "must be 0 or absent without yield"},
        {"young: 1e9, poisson: 0.3, density: 1, hardness: 3",
         "materials.m: hardness: unknown key; the keys of a material are young, poisson, density, "
         "yield, tangent, rate, loss_factor, loss_frequency, relaxation"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: -0.1",
         "materials.m.loss_factor: -0.1: must be a ratio >= 0 and < 2"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: 2", "loss_factor: 2: must be a ratio"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: .nan", "loss_factor: .nan: must be"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: 5 %", "loss_factor: 5 %: must be"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_frequency: 1 kHz",
         "materials.m.loss_frequency: 1000: must be absent without loss_factor"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: 0.1, loss_frequency: 0",
         "loss_frequency: 0: must be a finite frequency > 0 Hz (1e-12 to 1e12 Hz)"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: 0.1, loss_frequency: 1 ms",
         "loss_frequency: 1 ms: must be a frequency, such as 20 kHz; ms is no frequency"},
        {RELAXES "0.5", "materials.m.relaxation: 0.5: must be a list of 1 to 8 mappings of share"},
        {RELAXES "[]", "materials.m.relaxation: 0 terms: must be 1 to 8"},
        {RELAXES "[{share: 0, time: 1}]",
         "materials.m.relaxation[0].share: 0: must be a share > 0 and < 1"},
        {RELAXES "[{share: 1, time: 1}]", "relaxation[0].share: 1: must be a share > 0 and < 1"},
        {RELAXES "[{share: 0.1, time: 0}]",
         "relaxation[0].time: 0: must be a finite time > 0 s (1e-12 to 1e12 s)"},
        {RELAXES "[{share: 0.1, time: -1}]", "relaxation[0].time: -1: must be a finite time"},
        {RELAXES "[{share: 0.1, time: 1 mm}]", "relaxation[0].time: 1 mm: "},
        {RELAXES "[{share: 0.1}]", "relaxation[0].time: missing: must be a finite time"},
        {RELAXES "[{time: 0.1}]", "relaxation[0].share: missing: must be a share"},
        {RELAXES "[{share: 0.1, time: 1, tau: 1}]",
         "relaxation[0]: tau: unknown key; the keys of a term of a relaxation are share, time"},
        {RELAXES "[{share: 0.1, time: 1}, 3]", "relaxation[1]: 3: must be a mapping"},
        {RELAXES "[{share: 0.6, time: 1}, {share: 0.4, time: 2}]",
         "materials.m.relaxation[1]: share: 0.4: all shares up to this one must add up to less "
         "than 1, not 1"},
        {"young: 1e9, poisson: 0.3, density: 1, loss_factor: 0, relaxation: [{share: 0.1, time: "
         "1}]",
         "materials.m.relaxation: must be absent beside loss_factor"},
        {RELAXES "[" NINE "]", "relaxation: 9 terms: must be 1 to 8"},
    };
    parse_bad_materials(bad, COUNT(bad));
}

/* Hutchinson's circle has a pole at poisson -0.793. */
static void refuses_a_shear_rule_outside_its_range(void **state)
{
    (void)state;
    parse_bad("materials:\n  foam: {young: 1e9, poisson: -0.9, density: 100}\nbodies:\n"
              "  b:\n    shape: beam\n    material: foam\n    radius: 0.01\n    length: 1\n"
              "    shear_factor: hutchinson\n",
              9, "bodies.b.shear_factor: hutchinson: must be a number here");
}

static void refuses_bad_tops(void **state)
{
    (void)state;
    parse_bad("[1, 2]\n", 1, "a list: must be a mapping of materials, bodies, contact");
    parse_bad("---\n", 2, "nothing: must be a mapping");
    parse_bad("bodies: {}\n", 1, "materials: missing");
    parse_bad("materials: {}\nbodies: {}\n", 1, "materials: 0 entries: must be 1 to");
    parse_bad(MATERIALS, 4, "bodies: nothing: must be a mapping of ids");
    parse_bad(MATERIALS "  {}\n", 5, "bodies: 0 entries: must be 1 to");
    parse_bad(MATERIALS "  w: {shape: half-space, material: steel}\nsettings: 1\n", 6,
              "settings: unknown key; the keys of the catalogue are materials, bodies, contact, "
              "friction, laws, begin, end");
    parse_bad(MATERIALS "  w: {shape: half-space, material: steel}\ncontact: {compliance: exact}\n",
              6, "contact.compliance: exact: must be one of half-space, matched");
    parse_bad(MATERIALS "  w: {shape: half-space, material: steel}\ncontact: {friction: 1}\n", 6,
              "contact: friction: unknown key; the keys of contact are compliance");
}

/* Of a list of pairs that begins on line 6. */
static void refuses_bad_friction(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        unsigned line;
        const char *fragment;
    } bad[] = {
        {" 0.2", 6, "friction: 0.2: must be a list of mappings of between, coefficient, deviation"},
        {" {between: [steel, glass], coefficient: 0.2}", 6, "friction: a mapping: must be a list"},
        {" [0.2]", 6, "friction[0]: 0.2: must be a mapping of between, coefficient, deviation"},
        {"\n- {between: [steel, glass]}", 7,
         "friction[0].coefficient: missing: must be a coefficient >= 0 and <= 10"},
        {"\n- {coefficient: 0.2}", 7,
         "friction[0].between: missing: must be a list of two names of materials"},
        {"\n- {between: [steel, glass], coefficient: 0.2}\n- {between: [steel], coefficient: 0.2}",
         8, "friction[1].between: a list: must be a list of two names of materials, which may be"},
        {"\n- {between: steel, coefficient: 0.2}", 7,
         "friction[0].between: steel: must be a list of two names of materials"},
        {"\n- between: [steel,\n    brass]\n  coefficient: 0.2", 8,
         "friction[0].between: brass: unknown material; must be one of glass, steel"},
        {"\n- {between: [[steel], glass], coefficient: 0.2}", 7,
         "friction[0].between: a list: unknown material"},
        {"\n- between: [steel, glass]\n  coefficient: 10.1", 8,
         "friction[0].coefficient: 10.1: must be a coefficient >= 0 and <= 10"},
        {"\n- {between: [steel, glass], coefficient: -0.1}", 7, "coefficient: -0.1: must be"},
        {"\n- {between: [steel, glass], coefficient: 20 %}", 7, "coefficient: 20 %: must be"},
        {"\n- {between: [steel, glass], coefficient: 0.2, deviation: -1}", 7,
         "friction[0].deviation: -1: must be a standard deviation >= 0 and <= 10"},
        {"\n- {between: [steel, glass], coefficient: 0.2, deviation: nan}", 7, "deviation: nan"},
        {"\n- {between: [steel, glass], coefficient: 0.2, static: 0.3}", 7,
         "friction[0]: static: unknown key; the keys of a pair of materials are between, "
         "coefficient, deviation"},
        /* in either order, whatever it says */
        {"\n- {between: [steel, glass], coefficient: 0.2}"
         "\n- {between: [steel, steel], coefficient: 0.3}"
         "\n- {between: [glass, steel], coefficient: 0.2}",
         9, "friction[2]: between glass and steel: must stand once, but is on line 7 already"},
        {"\n- {between: [steel, steel], coefficient: 0.2}"
         "\n- {between: [steel, steel], coefficient: 0.2}",
         8, "friction[1]: between steel and steel: must stand once, but is on line 7 already"},
        {" []\nfriction: []", 7, "friction: must stand once, but is on line 6 already"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 MATERIALS "  w: {shape: half-space, material: steel}\nfriction:%s\n", bad[i].text);
        parse_bad(text, bad[i].line, bad[i].fragment);
    }
}

/* However long the words, the message ends and shows where. */
static void bounds_its_messages(void **state)
{
    (void)state;
    char text[4096] = MATERIALS "  s: {shape: sphere, material: ";
    size_t length = strlen(text);
    for (int i = 0; i < 1000; i++)
        memcpy(text + length + 2 * (size_t)i, "\xC3\xA9", 2);
    memcpy(text + length + 2000, "}\n", 3);
    parse_bad(text, 5, "\xC3\xA9...: must be a name of materials");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_impossible_sizes),
        cmocka_unit_test(refuses_what_is_no_number),
        cmocka_unit_test(refuses_what_is_no_unit),
        cmocka_unit_test(accepts_decimal_numbers),
        cmocka_unit_test(refuses_unknown_words),
        cmocka_unit_test(refuses_missing_and_double_keys),
        cmocka_unit_test(refuses_bad_ids),
        cmocka_unit_test(refuses_bad_rates),
        cmocka_unit_test(refuses_bad_materials),
        cmocka_unit_test(refuses_a_shear_rule_outside_its_range),
        cmocka_unit_test(refuses_bad_tops),
        cmocka_unit_test(refuses_bad_friction),
        cmocka_unit_test(bounds_its_messages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
