/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests endpoint/question.c, hash.c and key_map.c: what makes two requests the same question. */
#include "sample.h"

#include "exchange/key_map.h"
#include "exchange/question.h"

static struct sample sample;

static bool same(struct digest a, struct digest b)
{
    return a.first == b.first && a.second == b.second;
}

static struct digest fresh_digest(void)
{
    sample_fill(&sample);
    return question_digest_single(&sample.wire);
}

static void ignores_who_asks(void **state)
{
    (void)state;
    struct digest before = fresh_digest();
    sample.wire.client[3] = 1;
    sample.wire.sequence = 8;
    /* behind the end of the text */
    sample.bodies[0].id[20] = 'x';
    assert_true(same(question_digest_single(&sample.wire), before));
}

#define MATTERS(lvalue, value)                                                                     \
    do {                                                                                           \
        struct digest before = fresh_digest();                                                     \
        sample.lvalue = (value);                                                                   \
        assert_false(same(question_digest_single(&sample.wire), before));                          \
    } while (0)

static void heeds_everything_that_is_asked(void **state)
{
    (void)state;
    MATTERS(bodies[1].id[0], 'x');
    MATTERS(bodies[1].position[2], 1e-300);
    MATTERS(bodies[1].orientation[0], 0.99999);
    MATTERS(bodies[0].velocity[1], -0.0);
    MATTERS(bodies[0].angular_velocity[1], 1.0);
    MATTERS(bodies[0].state[0], 'x');
    MATTERS(bodies[0].elapsed, 1.0);
    MATTERS(bodies[0].specimen[0], 'x');
    MATTERS(contacts[0].a, 1);
    MATTERS(contacts[0].b, 0);
    MATTERS(contacts[0].point[0], 1.0);
    MATTERS(contacts[0].normal[0], 1.0);
    MATTERS(contacts[0].gap, 1.0);
    MATTERS(contacts[0].gap_acceleration, 1.0);
    MATTERS(delassus[3], 3.0000000000000004);
    MATTERS(wire.delassus._length, 0);
    MATTERS(wire.delassus._length, 36);
    MATTERS(wire.contacts._length, 1);
    MATTERS(wire.bodies._length, 1);
    MATTERS(wire.options.tolerance, 1e-3);
    MATTERS(wire.options.horizon, 1.0);
    MATTERS(wire.options.contact_model, 1);
    MATTERS(wire.options.method, 1);
    MATTERS(wire.options.compliance, 1);
    MATTERS(wire.options.dents, 1);
    MATTERS(wire.options.conditioning, true);
    MATTERS(wire.options.trace, true);
    MATTERS(wire.options.deadline, 1.0);
    MATTERS(wire.options.friction, 1);
    MATTERS(contacts[0].friction, 0.1);
    MATTERS(contacts[1].tangent[2], 1.0);
}

/* As before there was friction: replies are stored by the digest, and asked for again by it. */
static void a_question_without_friction_keeps_its_digest(void **state)
{
    (void)state;
    const struct digest of_0_2_0 = {0x817eac1af0d16aaf, 0x51efacf1a2e29835};
    assert_true(same(fresh_digest(), of_0_2_0));
    sample.contacts[1].tangent[0] = -0.0;
    assert_true(same(question_digest_single(&sample.wire), of_0_2_0));
    /* of which contact it is stated */
    sample.contacts[0].friction = 0.2;
    struct digest first = question_digest_single(&sample.wire);
    sample.contacts[0].friction = 0.0;
    sample.contacts[1].friction = 0.2;
    assert_false(same(question_digest_single(&sample.wire), first));
}

static void copies_outlive_their_sample(void **state)
{
    (void)state;
    percuss_v1_Request both[2];
    struct digest digest = fresh_digest();
    both[0] = both[1] = sample.wire;
    both[1].delassus._length = 0;
    both[1].delassus._buffer = NULL;
    percuss_v1_Override override = {PERCUSS_PARAMETER_YOUNG, 71e9};
    percuss_v1_BodyMotion varied[2];
    memcpy(varied, sample.bodies, sizeof varied);
    varied[1].overrides._buffer = &override;
    varied[1].overrides._length = 1;
    both[1].bodies._buffer = varied;
    struct digest with_override = question_digest_single(&both[1]);
    override.value = 72e9;
    assert_false(same(question_digest_single(&both[1]), with_override));
    percuss_v1_Request *copies = question_copy(both, 2);
    memset(&sample, 0xff, sizeof sample);
    memset(varied, 0xff, sizeof varied);
    override.value = 0.0;
    assert_true(same(question_digest_single(&copies[0]), digest));
    assert_true(copies[1].bodies._buffer[1].velocity[2] == -0.5);
    assert_int_equal(copies[1].delassus._length, 0);
    assert_int_equal(copies[1].bodies._buffer[1].overrides._length, 1);
    assert_true(copies[1].bodies._buffer[1].overrides._buffer[0].value == 72e9);
    free(copies);
}

/* Flipping any bit of a small input flips about half of the digest. */
/* A batch may hold no request at all, and has no list then. */
static void copies_nothing(void **state)
{
    (void)state;
    percuss_v1_Request *copy = question_copy(NULL, 0);
    assert_non_null(copy);
    free(copy);
}

static void spreads_every_bit(void **state)
{
    (void)state;
    for (int bit = 0; bit < 256; bit++) {
        unsigned char data[32] = {0};
        struct hasher plain = {0}, flipped = {0};
        hash_bytes(&plain, data, sizeof data);
        data[bit / 8] ^= (unsigned char)(1 << bit % 8);
        hash_bytes(&flipped, data, sizeof data);
        struct digest a = hash_digest(&plain), b = hash_digest(&flipped);
        int changed =
            __builtin_popcountll(a.first ^ b.first) + __builtin_popcountll(a.second ^ b.second);
        assert_in_range(changed, 36, 92); /* 64 +- 5 standard deviations */
    }
}

static void finds_what_is_in_the_map(void **state)
{
    (void)state;
    enum { COUNT = 1000 };
    static struct key_node nodes[COUNT];
    struct key_map map;
    assert_true(key_map_create(&map, 64));
    for (uint64_t i = 0; i < COUNT; i++) {
        nodes[i].key = (struct digest){i, i % 3};
        key_map_insert(&map, &nodes[i]);
    }
    for (uint64_t i = 0; i < COUNT; i += 2)
        key_map_remove(&map, &nodes[i]);
    assert_int_equal(map.count, COUNT / 2);
    for (uint64_t i = 0; i < COUNT; i++) {
        struct key_node *found = key_map_find(&map, (struct digest){i, i % 3});
        assert_ptr_equal(found, i % 2 ? &nodes[i] : NULL);
    }
    key_map_release(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ignores_who_asks),
        cmocka_unit_test(heeds_everything_that_is_asked),
        cmocka_unit_test(a_question_without_friction_keeps_its_digest),
        cmocka_unit_test(copies_outlive_their_sample),
        cmocka_unit_test(copies_nothing),
        cmocka_unit_test(spreads_every_bit),
        cmocka_unit_test(finds_what_is_in_the_map),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
