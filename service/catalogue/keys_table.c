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
    {"materials", KEY_CALLER, .required = true,
     KEY_SAYS(NULL, "the materials by their names, which bodies refer to")},
    {"bodies", KEY_CALLER, .required = true,
     KEY_SAYS(NULL, "the bodies by their ids, which requests name: 1 to 63 bytes")},
    {"contact", KEY_SECTION, .nested = &keys_contact,
     KEY_SAYS("the defaults of its keys", "how contacts are modelled")},
    {"begin", KEY_FLAG, KEY_OF(body_set, begin),
     KEY_SAYS("false",
              "the first line of a file that must end with `end: true`: one that is cut off, or "
              "being written while it is read, is refused")},
    {"end", KEY_FLAG, KEY_OF(body_set, end), KEY_SAYS("false", "the last line of such a file")},
};
const struct key_table keys_top = {"the catalogue", TABLE(top)};

static const struct key contact[] = {
    {"compliance", KEY_WORD, KEY_OF(body_set, compliance), KEY_WORDS(compliances),
     KEY_SAYS("matched",
              "local compliance: Hertz's of a half-space, or corrected for the finite body where "
              "that is known (rods, cylinders, spheres; a beam's side has its own either way)")},
};
const struct key_table keys_contact = {"contact", TABLE(contact)};

static const struct key material[] = {
    {"young", KEY_NUMBER, &limit_young, true, KEY_OF(stated_material, material.young),
     KEY_SAYS(NULL, "Young's modulus")},
    {"poisson", KEY_NUMBER, &limit_poisson, true, KEY_OF(stated_material, material.poisson),
     KEY_SAYS(NULL, "Poisson's ratio")},
    {"density", KEY_NUMBER, &limit_density, true, KEY_OF(stated_material, material.density),
     KEY_SAYS(NULL, "mass of a volume")},
    {"yield", KEY_YIELD, &limit_yield,
     KEY_SAYS(
         "elastic, which answers warn of where a metal would yield",
         "yield stress in tension, beyond which a contact leaves a dent; none: a material that "
         "is meant to stay elastic")},
    {"tangent", KEY_NUMBER, &limit_tangent, false, KEY_OF(stated_material, material.tangent),
     KEY_SAYS("0", "slope of the stress-strain curve beyond yield; 0: ideally plastic")},
    {"loss_factor", KEY_NUMBER, &limit_loss_factor, false, KEY_OF(stated_material, loss_factor),
     KEY_SAYS("not stated",
              "energy that a cycle of strain loses over 2 pi of what it stores, tan delta: 0.02 to "
              "0.1 of hard plastics, 0.05 to 1 of rubber; 0: a soft material that is meant to lose "
              "nothing")},
};
const struct key_table keys_material = {"a material", TABLE(material)};

static const struct key body[] = {
    {"shape", KEY_KIND, .required = true, KEY_OF(body, kind),
     KEY_SAYS(NULL, "what kind of body it is, on which its other keys depend")},
    {"material", KEY_NAME, .required = true, KEY_OF(body, material.name),
     KEY_SAYS(NULL, "what it is made of")},
};
const struct key_table keys_body = {NULL, TABLE(body)};

static const struct key own[] = {
    {"shape", KEY_KIND, .required = true, KEY_OF(body, kind),
     KEY_SAYS(NULL, "what kind of body it is, on which its other keys depend")},
    {"material", KEY_NAME, .required = false, KEY_OF(body, material.name),
     KEY_SAYS("the file's own",
              "what it is made of; beside a reduced body only where its file holds a single "
              "material, with the same Poisson's ratio")},
};
const struct key_table keys_own = {NULL, TABLE(own)};
