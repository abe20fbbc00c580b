/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/keys.h"
#include "model/body.h"

#define SPHERE   KEYS_OF(SHAPE_SPHERE)
#define ROD      KEYS_OF(SHAPE_ROD)
#define BEAM     KEYS_OF(SHAPE_BEAM)
#define CYLINDER KEYS_OF(SHAPE_CYLINDER)
#define BLOCK    KEYS_OF(SHAPE_BLOCK)

#define TABLE(array)        array, sizeof array / sizeof *array
#define WORDS(array)        .words = array, .word_count = sizeof array / sizeof *array
#define OF_BODY(member)     .offset = offsetof(struct body, member)
#define OF_MATERIAL(member) .offset = offsetof(struct material, member)

static const char *const shapes[] = {
    [SHAPE_SPHERE] = "sphere",     [SHAPE_ROD] = "rod",     [SHAPE_BEAM] = "beam",
    [SHAPE_CYLINDER] = "cylinder", [SHAPE_BLOCK] = "block", [SHAPE_HALF_SPACE] = "half-space",
};
static const char *const theories[] = {
    [THEORY_TIMOSHENKO] = "timoshenko",
    [THEORY_EULER_BERNOULLI] = "euler-bernoulli",
};
static const char *const rod_ends[] = {
    [SUPPORT_FREE] = "free",
    [SUPPORT_CLAMPED] = "fixed",
};
static const char *const beam_ends[] = {
    [SUPPORT_FREE] = "free",
    [SUPPORT_PINNED] = "pinned",
    [SUPPORT_CLAMPED] = "clamped",
};
static const char *const shear_rules[] = {
    [SHEAR_COWPER] = "cowper",
    [SHEAR_HUTCHINSON] = "hutchinson",
};
static const char *const compliances[] = {
    [PERCUSS_COMPLIANCE_HALF_SPACE] = "half-space",
    [PERCUSS_COMPLIANCE_MATCHED] = "matched",
};
static const struct limit limit_modes = {1.0, LIMIT_MODES, false, false,
                                         "a whole number, 1 to 5000; absent: from the tolerance"};

static const struct key top[] = {
    {"materials", KEY_CALLER, .required = true, .shapes = KEYS_ANY},
    {"bodies", KEY_CALLER, .required = true, .shapes = KEYS_ANY},
    {"contact", KEY_SECTION, .shapes = KEYS_ANY, .nested = &keys_contact},
};
const struct key_table keys_top = {"the catalogue", TABLE(top)};

static const struct key contact[] = {
    {"compliance", KEY_WORD, .shapes = KEYS_ANY, .offset = offsetof(struct body_set, compliance),
     WORDS(compliances)},
};
const struct key_table keys_contact = {"contact", TABLE(contact)};

static const struct key material[] = {
    {"young", KEY_NUMBER, &limit_young, true, KEYS_ANY, OF_MATERIAL(young)},
    {"poisson", KEY_NUMBER, &limit_poisson, true, KEYS_ANY, OF_MATERIAL(poisson)},
    {"density", KEY_NUMBER, &limit_density, true, KEYS_ANY, OF_MATERIAL(density)},
    {"yield", KEY_NUMBER, &limit_yield, false, KEYS_ANY, OF_MATERIAL(yield)},
    {"tangent", KEY_NUMBER, &limit_tangent, false, KEYS_ANY, OF_MATERIAL(tangent)},
};
const struct key_table keys_material = {"a material", TABLE(material)};

static const struct key section[] = {
    {"width", KEY_NUMBER, &limit_length, true, BEAM, OF_BODY(width)},
    {"height", KEY_NUMBER, &limit_length, true, BEAM, OF_BODY(height)},
};
static const struct key_table keys_section = {"a section", TABLE(section)};

/* A beam's radius is optional: it has a section otherwise. */
static const struct key body[] = {
    {"shape", KEY_WORD, NULL, true, KEYS_ANY, OF_BODY(shape), WORDS(shapes)},
    {"material", KEY_NAME, NULL, true, KEYS_ANY, OF_BODY(material.name)},
    {"radius", KEY_NUMBER, &limit_length, true, SPHERE | ROD | CYLINDER, OF_BODY(radius)},
    {"radius", KEY_NUMBER, &limit_length, false, BEAM, OF_BODY(radius)},
    {"section", KEY_SECTION, NULL, false, BEAM, .nested = &keys_section},
    {"length", KEY_NUMBER, &limit_length, true, ROD | BEAM | CYLINDER, OF_BODY(length)},
    {"size", KEY_NUMBERS, &limit_length, true, BLOCK, OF_BODY(size)},
    {"tip_radius", KEY_NUMBER, &limit_length, false, ROD, OF_BODY(tip_radius)},
    {"lateral_inertia", KEY_FLAG, NULL, false, ROD, OF_BODY(lateral_inertia)},
    {"theory", KEY_WORD, NULL, false, BEAM, OF_BODY(theory), WORDS(theories)},
    {"shear_factor", KEY_SHEAR, &limit_shear_factor, false, BEAM, WORDS(shear_rules)},
    {"ends", KEY_ENDS, NULL, false, ROD, OF_BODY(supports), WORDS(rod_ends)},
    {"ends", KEY_ENDS, NULL, false, BEAM, OF_BODY(supports), WORDS(beam_ends)},
    {"damping", KEY_NUMBER, &limit_damping, false, ROD | BEAM, OF_BODY(damping)},
    {"modes", KEY_WHOLE, &limit_modes, false, ROD | BEAM, OF_BODY(modes)},
};
const struct key_table keys_body = {NULL, TABLE(body)};
