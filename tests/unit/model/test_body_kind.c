/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/model/body_kind.c: every kind of the list says all that is asked of it,
 * under a name and a number of its own. */
#include <string.h>

#include "check.h"
#include "model/body.h"
#include "model/body_kind.h"

static void kinds_keep_their_numbers(void **state)
{
    (void)state;
    /* catalogue revisions hash them */
    static const char *const names[] = {"sphere", "rod",        "beam", "cylinder",
                                        "block",  "half-space", "mesh"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        assert_string_equal(body_kind_at(i)->name, names[i]);
        assert_int_equal(body_kind_number(body_kind_at(i)), i);
    }
    /* a new one joins the end, and this list */
    assert_null(body_kind_at(sizeof names / sizeof *names));
}

static void every_kind_is_complete(void **state)
{
    (void)state;
    const struct body_kind *kind;
    for (size_t i = 0; (kind = body_kind_at(i)); i++) {
        assert_true(kind->name && kind->complete && kind->smallest_radius && kind->faces);
        assert_true(kind->describe && (kind->keys || !kind->key_count));
        /* what vibrates says how */
        assert_true(kind->family_count <= BODY_MOST_FAMILIES);
        assert_int_equal(kind->family_count > 0, kind->theory != NULL);
        assert_int_equal(kind->family_count > 0, kind->load != NULL);
        for (size_t f = 0; f < kind->family_count; f++) {
            const struct mode_family *family = kind->families[f];
            assert_true(family->find && family->participations && family->compliance);
        }
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(kind->name, body_kind_at(j)->name);
    }
    assert_null(body_kind_at(1000));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds_keep_their_numbers),
        cmocka_unit_test(every_kind_is_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
