/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/solve/error/neighbours.c: ranges of solutions whose numbers are written down
 * here. */
#include "check.h"
#include "solve/error/neighbours.h"

/* Two contacts that 2 N s and 4 N s bring to rest. */
static double compression[2] = {2.0, 4.0};

static struct problem two_contacts(void)
{
    return (struct problem){.contact_count = 2, .impulse_compression = compression};
}

/* A solution by the impulses and the numbers of sub-impacts. */
static struct impact_outcome solution(struct track tracks[2], double first, size_t first_count,
                                      double second, size_t second_count)
{
    tracks[0] = (struct track){.impulse = first, .count = first_count};
    tracks[1] = (struct track){.impulse = second, .count = second_count};
    return (struct impact_outcome){.tracks = tracks};
}

static void an_answer_alone_can_be_anything(void **state)
{
    (void)state;
    struct problem problem = two_contacts();
    struct track tracks[2];
    struct impact_outcome answer = solution(tracks, 3.0, 1, 7.0, 2);
    struct neighbours neighbours;
    neighbours_begin(&neighbours, &problem, &answer);
    assert_int_equal(neighbours.solutions, 1);
    near(neighbours.low[0], 0.5, 0.0);
    near(neighbours.high[1], 0.75, 0.0);
    assert_true(neighbours_distance(&neighbours, &problem, &answer) == INFINITY);
}

static void others_widen_the_range(void **state)
{
    (void)state;
    struct problem problem = two_contacts();
    struct track tracks[3][2];
    struct impact_outcome answer = solution(tracks[0], 3.0, 1, 7.0, 5);
    struct impact_outcome lower = solution(tracks[1], 2.5, 4, 7.0, 3);
    struct impact_outcome higher = solution(tracks[2], 3.25, 2, 7.5, 4);
    struct neighbours neighbours;
    neighbours_begin(&neighbours, &problem, &answer);
    neighbours_add(&neighbours, &problem, &lower);
    neighbours_add(&neighbours, &problem, &higher);
    assert_int_equal(neighbours.solutions, 3);
    near(neighbours.low[0], 0.25, 0.0);
    near(neighbours.high[0], 0.625, 0.0);
    near(neighbours.low[1], 0.75, 0.0);
    near(neighbours.high[1], 0.875, 0.0);
    assert_int_equal(neighbours.fewest[0], 1);
    assert_int_equal(neighbours.most[0], 4);
    assert_int_equal(neighbours.fewest[1], 3);
    assert_int_equal(neighbours.most[1], 5);
    /* the ends are 1/4 and 1/8 away from 1/2, and 0 and 1/8 from 3/4 */
    near(neighbours_distance(&neighbours, &problem, &answer), 0.25, 0.0);
    near(neighbours_distance(&neighbours, &problem, &higher), 0.375, 0.0);
}

/* What does not approach has no restitution, and no distance. */
static void a_contact_without_restitution_is_left_out(void **state)
{
    (void)state;
    static double none[2] = {2.0, 0.0};
    struct problem problem = {.contact_count = 2, .impulse_compression = none};
    struct track tracks[2][2];
    struct impact_outcome answer = solution(tracks[0], 3.0, 1, 1.0, 1);
    struct impact_outcome other = solution(tracks[1], 3.5, 1, 9.0, 2);
    struct neighbours neighbours;
    neighbours_begin(&neighbours, &problem, &answer);
    neighbours_add(&neighbours, &problem, &other);
    assert_true(isnan(neighbours.low[1]) && isnan(neighbours.high[1]));
    near(neighbours_distance(&neighbours, &problem, &answer), 0.25, 0.0);
    assert_int_equal(neighbours.most[1], 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_answer_alone_can_be_anything),
        cmocka_unit_test(others_widen_the_range),
        cmocka_unit_test(a_contact_without_restitution_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
