/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/base/arena.c: alignment, zeros, reuse, and sizes that cannot be. */
#include <string.h>

#include "base/arena.h"
#include "check.h"

static void pieces_are_aligned_zero_and_apart(void **state)
{
    (void)state;
    struct arena arena = {0};
    unsigned char *pieces[200];
    size_t sizes[200];
    for (size_t i = 0; i < 200; i++) {
        sizes[i] = (i * 7919) % 9000;
        pieces[i] = arena_take(&arena, sizes[i], 1);
        assert_non_null(pieces[i]);
        assert_int_equal((uintptr_t)pieces[i] % 32, 0);
        for (size_t k = 0; k < sizes[i]; k++)
            assert_int_equal(pieces[i][k], 0);
        memset(pieces[i], (int)(i % 255 + 1), sizes[i]);
    }
    /* whoever overlapped another would show its mark */
    for (size_t i = 0; i < 200; i++)
        for (size_t k = 0; k < sizes[i]; k++)
            assert_int_equal(pieces[i][k], i % 255 + 1);
    arena_release(&arena);
}

static void a_reset_gives_the_same_memory_again(void **state)
{
    (void)state;
    struct arena arena = {0};
    void *first[3][40];
    for (int round = 0; round < 3; round++) {
        for (size_t i = 0; i < 40; i++) {
            /* some larger than a block of 256 KiB */
            size_t size = i % 7 == 3 ? 400000 : 9000 + i;
            unsigned char *piece = arena_take(&arena, size, 1);
            assert_non_null(piece);
            assert_int_equal(piece[0] | piece[size - 1], 0);
            memset(piece, 0xff, size);
            first[round][i] = piece;
        }
        arena_reset(&arena);
    }
    assert_memory_equal(first[0], first[1], sizeof first[0]);
    assert_memory_equal(first[0], first[2], sizeof first[0]);
    arena_release(&arena);
}

/* A larger demand after a smaller one finds or makes room, whatever the order of the blocks. */
static void blocks_of_any_order_are_reused(void **state)
{
    (void)state;
    struct arena arena = {0};
    const size_t rounds[4][3] = {
        {1000, 300000, 1000}, {300000, 1000, 500000}, {10, 10, 10}, {900000, 300000, 10}};
    for (int round = 0; round < 4; round++) {
        unsigned char *pieces[3];
        for (int i = 0; i < 3; i++) {
            pieces[i] = arena_take(&arena, rounds[round][i], 1);
            assert_non_null(pieces[i]);
            memset(pieces[i], i + 1, rounds[round][i]);
        }
        for (int i = 0; i < 3; i++) {
            assert_int_equal(pieces[i][0], i + 1);
            assert_int_equal(pieces[i][rounds[round][i] - 1], i + 1);
        }
        arena_reset(&arena);
    }
    arena_release(&arena);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    struct arena arena = {0};
    assert_null(arena_take(&arena, SIZE_MAX, 1));
    assert_null(arena_take(&arena, SIZE_MAX / 2, 3));
    assert_null(arena_take(&arena, 3, SIZE_MAX / 2));
#ifndef __SANITIZE_ADDRESS__ /* which ends the program over what the allocator would refuse */
    assert_null(arena_take(&arena, SIZE_MAX - 64, 1));
#endif
    /* none at all is a place, though an empty one */
    assert_non_null(arena_take(&arena, 0, 8));
    assert_non_null(arena_take(&arena, 8, 0));
    void *piece = arena_take(&arena, 8, 8);
    assert_non_null(piece);
    arena_release(&arena);
    assert_null(arena.first);
    /* empty arenas may be reset and released */
    arena_reset(&arena);
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_aligned_zero_and_apart),
        cmocka_unit_test(a_reset_gives_the_same_memory_again),
        cmocka_unit_test(blocks_of_any_order_are_reused),
        cmocka_unit_test(impossible_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
