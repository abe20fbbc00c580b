/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/impact/response.c: what is found again, by what, and what goes to make place. */
#include "impact/response.h"

#include "check.h"

enum { LENGTH = 8, LEVEL = 21 };

/* Pairs of rows that differ in one number alone, in its last bits. */
struct rows {
    double first[LENGTH], second[LENGTH];
};

static struct rows rows_of(int which)
{
    struct rows rows;
    for (int k = 0; k < LENGTH; k++) {
        rows.first[k] = cos(k + 0.3);
        rows.second[k] = sin(k + 0.3);
    }
    rows.second[LENGTH - 1] *= 1.0 + 2.3e-16 * which;
    return rows;
}

static struct response *find(struct responses **kept, int which, size_t length)
{
    struct rows rows = rows_of(which);
    struct response *found =
        responses_find(kept, (const double *const[]){rows.first, rows.second}, length);
    assert_non_null(found);
    return found;
}

/* Fills the block of a level by a number, or finds it. True: it was there. */
static bool ask(struct response *response, int level, double number)
{
    bool known;
    double(*block)[NODES] = response_block(response, level, &known);
    for (int i = 0; i < STEP_POINTS; i++)
        for (int j = 0; j < NODES; j++) {
            assert_true(block[i][j] == (known ? number + i * NODES + j : 0.0));
            block[i][j] = number + i * NODES + j;
        }
    return known;
}

static void rows_are_told_apart_by_their_last_bit(void **state)
{
    (void)state;
    struct responses *kept = NULL;
    assert_false(ask(find(&kept, 0, LENGTH), LEVEL, 10.0));
    assert_false(ask(find(&kept, 1, LENGTH), LEVEL, 20.0));
    assert_false(ask(find(&kept, 1, LENGTH - 4), LEVEL, 30.0));
    assert_true(ask(find(&kept, 0, LENGTH), LEVEL, 10.0));
    assert_true(ask(find(&kept, 1, LENGTH), LEVEL, 20.0));
    assert_true(ask(find(&kept, 1, LENGTH - 4), LEVEL, 30.0));
    /* nor is zero minus zero, nor the pair the other way round */
    struct rows rows = rows_of(0);
    const double *const turned[] = {rows.second, rows.first};
    assert_false(ask(responses_find(&kept, turned, LENGTH), LEVEL, 40.0));
    double zero[LENGTH] = {0.0};
    double minus[LENGTH] = {-0.0};
    assert_false(ask(responses_find(&kept, (const double *[]){zero, zero}, LENGTH), LEVEL, 50.0));
    assert_false(ask(responses_find(&kept, (const double *[]){minus, zero}, LENGTH), LEVEL, 60.0));
    responses_free(kept);
}

/* A level takes the place of one that is RESPONSE_LEVELS away, and of no other. */
static void levels_that_lie_together_are_kept(void **state)
{
    (void)state;
    struct responses *kept = NULL;
    struct response *response = find(&kept, 0, LENGTH);
    for (int level = LEVEL; level < LEVEL + RESPONSE_LEVELS; level++)
        assert_false(ask(response, level, 100.0 * level));
    for (int level = LEVEL; level < LEVEL + RESPONSE_LEVELS; level++)
        assert_true(ask(response, level, 100.0 * level));
    assert_false(ask(response, LEVEL + RESPONSE_LEVELS, 7.0));
    assert_false(ask(response, LEVEL, 8.0));
    assert_true(ask(response, LEVEL + 1, 100.0 * (LEVEL + 1)));
    responses_free(kept);
}

/* The one that was not asked of for longest goes, with all its levels, also for a longer row. */
static void the_oldest_makes_place(void **state)
{
    (void)state;
    struct responses *kept = NULL;
    for (int i = 0; i < RESPONSE_PAIRS; i++)
        assert_false(ask(find(&kept, i, LENGTH - 4 * (i == 1)), LEVEL, 10.0 * i));
    assert_true(ask(find(&kept, 0, LENGTH), LEVEL, 0.0));
    struct response *taken = find(&kept, RESPONSE_PAIRS, LENGTH);
    assert_false(ask(taken, LEVEL, 1.0));
    assert_false(ask(taken, LEVEL + 1, 2.0));
    assert_true(ask(find(&kept, 0, LENGTH), LEVEL, 0.0));
    for (int i = 2; i < RESPONSE_PAIRS; i++)
        assert_true(ask(find(&kept, i, LENGTH), LEVEL, 10.0 * i));
    assert_true(ask(find(&kept, RESPONSE_PAIRS, LENGTH), LEVEL, 1.0));
    assert_false(ask(find(&kept, 1, LENGTH - 4), LEVEL, 10.0));
    responses_free(kept);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_told_apart_by_their_last_bit),
        cmocka_unit_test(levels_that_lie_together_are_kept),
        cmocka_unit_test(the_oldest_makes_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
