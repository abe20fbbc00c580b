/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/authorisation.c. */
#include "endpoint/authorisation.h"

#include "check.h"
#include "exchange/key_map.h"

static const uint8_t client[16] = {1}, other[16] = {2};

static struct digest participant(uint8_t number)
{
    const uint8_t octets[16] = {number, 9};
    return digest_of_octets(octets);
}

static void a_guid_tells_its_participant(void **state)
{
    (void)state;
    const uint8_t reader[16] = {3, 9, [12] = 0, 0, 4, 7};
    struct digest found = authorisation_participant(digest_of_octets(reader));
    assert_true(found.first == participant(3).first && found.second == participant(3).second);
}

static void whoever_comes_first_has_it_while_he_lives(void **state)
{
    (void)state;
    struct authorisation *authorisation = authorisation_create();
    /* nobody's is everybody's */
    assert_true(authorisation_allow(authorisation, client, participant(1)));
    /* the first one's, whatever others read */
    assert_true(authorisation_add(authorisation, client, participant(1)));
    assert_true(authorisation_add(authorisation, client, participant(1)));
    assert_true(authorisation_add(authorisation, client, participant(2)));
    assert_true(authorisation_add(authorisation, client, participant(3)));
    assert_true(authorisation_allow(authorisation, client, participant(1)));
    assert_false(authorisation_allow(authorisation, client, participant(2)));
    assert_true(authorisation_allow(authorisation, other, participant(2)));
    /* he stays as long as he has a reader, and then it is the next one's */
    authorisation_remove(authorisation, client, participant(1));
    assert_true(authorisation_allow(authorisation, client, participant(1)));
    authorisation_remove(authorisation, client, participant(1));
    assert_false(authorisation_allow(authorisation, client, participant(1)));
    assert_true(authorisation_allow(authorisation, client, participant(2)));
    assert_false(authorisation_allow(authorisation, client, participant(3)));
    /* who waited in between may go */
    authorisation_add(authorisation, client, participant(1));
    authorisation_remove(authorisation, client, participant(3));
    authorisation_remove(authorisation, client, participant(2));
    assert_true(authorisation_allow(authorisation, client, participant(1)));
    authorisation_remove(authorisation, client, participant(1));
    assert_true(authorisation_allow(authorisation, client, participant(4)));
    /* what never came changes nothing */
    authorisation_remove(authorisation, client, participant(4));
    assert_true(authorisation_add(authorisation, other, participant(4)));
    authorisation_free(authorisation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_guid_tells_its_participant),
        cmocka_unit_test(whoever_comes_first_has_it_while_he_lives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
