/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/keys.h"
#include "model/body.h"

#define TABLE(array) array, sizeof array / sizeof *array, NULL

static const char *const compliances[] = {
    [PERCUSS_COMPLIANCE_HALF_SPACE] = "half-space",
    [PERCUSS_COMPLIANCE_MATCHED] = "matched",
};
static const struct key top[] = {
    {"materials", KEY_CALLER, .required = true},
    {"bodies", KEY_CALLER, .required = true},
    {"contact", KEY_SECTION, .nested = &keys_contact},
    {"begin", KEY_FLAG, KEY_OF(body_set, begin)},
    {"end", KEY_FLAG, KEY_OF(body_set, end)},
};
const struct key_table keys_top = {"the catalogue", TABLE(top)};

static const struct key contact[] = {
    {"compliance", KEY_WORD, KEY_OF(body_set, compliance), KEY_WORDS(compliances)},
};
const struct key_table keys_contact = {"contact", TABLE(contact)};

static const struct key material[] = {
    {"young", KEY_NUMBER, &limit_young, true, KEY_OF(material, young)},
    {"poisson", KEY_NUMBER, &limit_poisson, true, KEY_OF(material, poisson)},
    {"density", KEY_NUMBER, &limit_density, true, KEY_OF(material, density)},
    {"yield", KEY_NUMBER, &limit_yield, false, KEY_OF(material, yield)},
    {"tangent", KEY_NUMBER, &limit_tangent, false, KEY_OF(material, tangent)},
};
const struct key_table keys_material = {"a material", TABLE(material)};

static const struct key body[] = {
    {"shape", KEY_KIND, .required = true, KEY_OF(body, kind)},
    {"material", KEY_NAME, .required = true, KEY_OF(body, material.name)},
};
const struct key_table keys_body = {NULL, TABLE(body)};

static const struct key own[] = {
    {"shape", KEY_KIND, .required = true, KEY_OF(body, kind)},
    {"material", KEY_NAME, .required = false, KEY_OF(body, material.name)},
};
const struct key_table keys_own = {NULL, TABLE(own)};
