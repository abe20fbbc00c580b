/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests what the tables of keys say for the reference (keys.c and the kinds of bodies): each
 * key has a meaning, and a default that is stated holds. */
#include "catalogue/keys.h"
#include "model/body_kind.h"
#include "parse.h"

#define MATERIAL "materials: {m: {young: 70e9, poisson: 0.3, density: 2700, yield: 1e8%s}}\n"

/* Bodies with the keys that they need and no others; "%s" is where one more goes. */
static const char *const BODIES[] = {
    "sphere, radius: 0.01%s",          "rod, radius: 0.01, length: 1%s",
    "beam, radius: 0.01, length: 1%s", "cylinder, radius: 0.01, length: 0.02%s",
    "block, size: [0.1, 0.1, 0.1]%s",  "half-space%s",
};

static void revision_of(const char *in_material, const char *in_body, const char *body, char *to)
{
    char text[1024], whole[512];
    snprintf(whole, sizeof whole, body, in_body);
    int length = snprintf(text, sizeof text, MATERIAL, in_material);
    snprintf(text + length, sizeof text - (size_t)length, "bodies: {b: {material: m, shape: %s}}\n",
             whole);
    struct body_set *set = parse_good(text);
    strcpy(to, set->revision);
    body_set_free(set);
}

/* Whether a default is one that can be written. */
static bool is_stated(const struct key *key)
{
    double number;
    return key->otherwise && (key->type == KEY_WORD || key->type == KEY_ENDS ||
                              key->type == KEY_SHEAR || key->type == KEY_FLAG ||
                              units_read(key->otherwise, QUANTITY_NUMBER, &number) == UNITS_GOOD);
}

static void defaults_hold_where_they_are_written(void **state)
{
    (void)state;
    size_t written = 0;
    for (size_t i = 0; i < COUNT(BODIES); i++) {
        const struct body_kind *kind = body_kind_at(i);
        char plain[PERCUSS_ID_SIZE], stated[PERCUSS_ID_SIZE], text[160];
        assert_memory_equal(BODIES[i], kind->name, strlen(kind->name));
        revision_of("", "", BODIES[i], plain);
        for (size_t k = 0; k < kind->key_count; k++) {
            if (!is_stated(&kind->keys[k]))
                continue;
            snprintf(text, sizeof text, ", %s: %s", kind->keys[k].name, kind->keys[k].otherwise);
            revision_of("", text, BODIES[i], stated);
            assert_string_equal(stated, plain);
            written++;
        }
        for (size_t k = 0; k < keys_material.count; k++) {
            if (!is_stated(&keys_material.keys[k]))
                continue;
            snprintf(text, sizeof text, ", %s: %s", keys_material.keys[k].name,
                     keys_material.keys[k].otherwise);
            revision_of(text, "", BODIES[i], stated);
            assert_string_equal(stated, plain);
            written++;
        }
    }
    /* ends of rod, beam and block, lateral inertia, theory, shear factor, rigid blocks and
     * cylinders; tangent of each */
    assert_int_equal(written, 8 + COUNT(BODIES));
}

static void check_meanings(const struct key_table *table)
{
    const struct key *key;
    for (size_t i = 0; (key = key_at(table, i)); i++) {
        assert_non_null(key->meaning);
        /* what need not be there has a default, and nothing else has: what another key may stand
         * instead of names that one */
        assert_int_equal(key->required && !key->instead[0], !key->otherwise);
        if (key->nested && key->nested != &keys_contact)
            check_meanings(key->nested);
    }
}

static void every_key_has_a_meaning(void **state)
{
    (void)state;
    const struct key_table *const tables[] = {&keys_top,      &keys_contact,    &keys_friction,
                                              &keys_material, &keys_body,       &keys_own,
                                              &keys_site,     &keys_relaxation, &keys_law};
    const struct body_kind *kind;
    for (size_t i = 0; i < COUNT(tables); i++)
        check_meanings(tables[i]);
    for (size_t i = 0; (kind = body_kind_at(i)); i++)
        check_meanings(&(struct key_table){kind->name, kind->keys, kind->key_count, NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_hold_where_they_are_written),
        cmocka_unit_test(every_key_has_a_meaning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
