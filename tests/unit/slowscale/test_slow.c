/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/slowscale/slowscale.c, pairs.c and group.c: one question an impact whatever the
 * bodies do meanwhile and in whichever order they are named, lists and totals, latches, groups. */
#include "unit/slowscale/toy.h"

static void asks_once_while_bodies_overlap(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = 1;
    toy->answer[0] = two_hits;
    toy_step(toy, 0.0);
    assert_int_equal(toy->asked, 1);
    near(toy->bodies[0].velocity[0], 0.2, 0.0); /* the first is 0.1 ms away */
    near(percuss_slow_next(toy->slow), 1e-4, 1e-18);
    toy_run(toy, 4e-3, 1e-4);
    near(toy->bodies[0].velocity[0], 0.12, 1e-15);
    near(toy->bodies[1].velocity[0], 0.08, 1e-15);
    assert_true(toy->bodies[1].position[0] - toy->bodies[0].position[0] < 0.02 - 1e-4);
    toy_run(toy, 0.5, 1e-3);
    near(toy->bodies[0].velocity[0], 0.06, 1e-15);
    near(toy->bodies[1].velocity[0], 0.14, 1e-15);
    assert_int_equal(toy->asked, 1);
    assert_true(isinf(percuss_slow_next(toy->slow)));
    /* e by the engine's own matrix: 0.014 * 20 / 0.2 - 1 */
    near(toy->restitution[0], 0.4, 1e-14);
    near(toy->applied[0], 0.014, 1e-17);
    assert_string_equal(toy->message, "");
    /* the rigid positions are those of impulses at the times of the largest indentation */
    near(toy->bodies[1].position[0], 0.02 + 0.08 * (5.1e-3 - 1e-4) + 0.14 * (0.5 - 5.1e-3), 1e-14);
    struct percuss_slow_counts counts = percuss_slow_counts(toy->slow);
    assert_true(counts.impacts == 1 && counts.requests == 1 && counts.declared == 0);
    toy_free(toy);
}

/* Off the line of centres, so that the spheres turn as well: a millimetre of 10. */
static void a_pair_and_its_bodies_are_pushed_alike(void **state)
{
    (void)state;
    struct percuss_body_motion after[2][2];
    for (int way = 0; way < 2; way++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.engine.push = way ? toy_push : NULL;
        struct toy *toy = toy_create(2, &wishes);
        toy->bodies[1].position[1] = 1e-3;
        toy->answers = 1;
        toy->answer[0] = two_hits;
        toy_step(toy, 0.0);
        toy_run(toy, 0.1, 1e-3);
        memcpy(after[way], toy->bodies, sizeof after[way]);
        toy_free(toy);
    }
    for (int body = 0; body < 2; body++)
        for (int k = 0; k < 3; k++) {
            near(after[1][body].velocity[k], after[0][body].velocity[k], 1e-15);
            near(after[1][body].angular_velocity[k], after[0][body].angular_velocity[k], 1e-13);
        }
    near(after[1][0].velocity[0], 0.06, 1e-15);
    /* -1 mm below the second's centre, -(-1 mm) x 0.014 N s / 4e-6 kg m^2 */
    near(after[1][1].angular_velocity[2], 3.5, 1e-13);
}

static void total_and_list_end_with_the_same_velocities(void **state)
{
    (void)state;
    double end[2];
    for (int total = 0; total < 2; total++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.application = total ? PERCUSS_SLOW_TOTAL : PERCUSS_SLOW_LIST;
        struct toy *toy = toy_create(2, &wishes);
        toy->answers = 1;
        toy->answer[0] = two_hits;
        toy_step(toy, 0.0);
        if (total)
            near(toy->bodies[0].velocity[0], 0.06, 1e-15);
        toy_run(toy, 0.1, 1e-3);
        assert_int_equal(toy->asked, 1);
        end[total] = toy->bodies[0].velocity[0];
        toy_free(toy);
    }
    near(end[0], end[1], 1e-15);
}

/* After the list the bodies still overlap and approach: while the answer lasts nothing else can
 * happen, then it is a new impact. */
static void a_pair_that_goes_on_approaching_is_asked_about_again(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    struct toy_answer weak = two_hits;
    weak.subs[0][1].impulse = 0.001; /* e = -0.1 */
    toy->answers = 2;
    toy->answer[0] = weak;
    toy->answer[1] = two_hits;
    toy_step(toy, 0.0);
    toy_run(toy, 5.9e-3, 1e-4);
    near(toy->restitution[0], -0.1, 1e-14);
    assert_int_equal(toy->asked, 1);
    toy_run(toy, 7e-3, 1e-3);
    assert_int_equal(toy->asked, 2);
    /* the second question carries the vibration and its age: window 6 ms, now 6.9 ms */
    assert_string_equal(toy->question[1].bodies[0].state, "token-0-0");
    near(toy->question[1].bodies[0].elapsed, 0.9e-3, 1e-15);
    assert_string_equal(toy->question[0].bodies[0].state, "");
    toy_free(toy);
}

/* Collision detection may name the bodies of a pair in another order at every step. */
static void the_order_of_a_pair_does_not_matter(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    toy->flips = true;
    toy->answers = 1;
    toy->answer[0] = two_hits;
    toy_step(toy, 0.0);
    toy_run(toy, 0.1, 1e-4);
    assert_int_equal(toy->asked, 1);
    near(toy->bodies[0].velocity[0], 0.06, 1e-15);
    near(toy->bodies[1].velocity[0], 0.14, 1e-15);
    /* lying together again, asked for in either order */
    toy->bodies[1].position[0] = toy->bodies[0].position[0] + 0.02;
    toy->bodies[1].velocity[0] = toy->bodies[0].velocity[0];
    toy_step(toy, 0.0);
    assert_true(percuss_slow_rests(toy->slow, 0, 1, 0) && percuss_slow_rests(toy->slow, 1, 0, 0));
    toy_free(toy);
}

/* Trial states of event location ask nobody, however often. */
static void trials_ask_nobody(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    struct percuss_slow_contact contacts[TOY_BODIES];
    size_t n = toy_contacts(toy, contacts);
    for (int i = 0; i < 1000; i++)
        assert_true(percuss_slow_due(toy->slow, n, contacts));
    contacts[0].gap = 1e-9;
    assert_false(percuss_slow_due(toy->slow, n, contacts));
    contacts[0].gap = 0.0;
    toy->bodies[0].velocity[0] = 5e-4; /* below rest_speed */
    assert_false(percuss_slow_due(toy->slow, n, contacts));
    assert_int_equal(toy->asked, 0);
    toy_step(toy, 0.0);
    assert_int_equal(toy->asked, 0);
    assert_true(percuss_slow_rests(toy->slow, 1, 0, 0));
    toy_free(toy);
}

/* Touching neighbours belong to the question, with the whole matrix. */
static void coupled_contacts_are_one_question(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(3, &wishes);
    toy->bodies[2].position[0] += 5e-6; /* within group_gap */
    toy->answers = 1;
    toy->answer[0] = (struct toy_answer){.window = 1e-3,
                                         .count = {1, 1},
                                         .subs = {{{.end = 2e-4, .impulse = 0.02}},
                                                  {{.start = 1e-5, .end = 2e-4, .impulse = 0.02}}}};
    toy_step(toy, 0.0);
    assert_int_equal(toy->question[0].contact_count, 2);
    assert_int_equal(toy->question[0].body_count, 3);
    const double expected[4] = {20.0, -10.0, -10.0, 20.0};
    for (int i = 0; i < 4; i++)
        near(toy->matrix[0][i], expected[i], 1e-12);
    toy_run(toy, 0.01, 1e-3);
    near(toy->bodies[2].velocity[0], 0.2, 1e-15);
    near(toy->bodies[0].velocity[0], 0.0, 1e-15);
    assert_int_equal(toy->asked, 1);
    toy_free(toy);
}

/* A wall that is hit on both sides at once does not carry one impact to the other. */
static void a_fixed_body_does_not_couple(void **state)
{
    (void)state;
    for (int fixed = 0; fixed < 2; fixed++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.bodies = (struct percuss_slow_body[]){
            {.id = "s0"}, {.id = "wall", .fixed = fixed}, {.id = "s2"}};
        struct toy *toy = toy_create(3, &wishes);
        toy->inertias[1].mass = INFINITY;
        toy->bodies[2].velocity[0] = -0.1;
        const struct toy_answer hit = {
            .window = 1e-3,
            .count = {1, 1},
            .subs = {{{.end = 1e-4, .impulse = 0.03}}, {{.end = 1e-4, .impulse = 0.03}}}};
        toy->answers = 2;
        toy->answer[0] = toy->answer[1] = hit;
        toy_step(toy, 0.0);
        assert_int_equal(toy->asked, fixed ? 2 : 1);
        assert_int_equal(toy->question[0].contact_count, fixed ? 1 : 2);
        toy_run(toy, 0.01, 1e-3);
        near(toy->bodies[0].velocity[0], -0.1, 1e-15);
        near(toy->bodies[2].velocity[0], 0.2, 1e-15);
        near(toy->bodies[1].velocity[0], 0.0, 0.0);
        toy_free(toy);
    }
}

/* Many impacts of a row between two heavy ends without a service: nothing comes from nothing, and
 * no pair sinks into another. Steps of 0.1 ms without event location. */
static void nothing_comes_from_nothing(void **state)
{
    (void)state;
    size_t impacts = 0;
    for (int trial = 0; trial < 20; trial++) {
        struct percuss_slow_config wishes = percuss_slow_config_default();
        wishes.restitution = trial / 19.0;
        struct toy *toy = toy_create(4, &wishes);
        toy->inertias[0].mass = toy->inertias[3].mass = 5.0;
        for (int i = 0; i < 4; i++)
            toy->bodies[i].position[0] += 1e-3 * i;
        toy->bodies[0].velocity[0] = 0.02;
        toy->bodies[1].velocity[0] = 0.3 + 0.01 * trial;
        toy->bodies[3].velocity[0] = -0.02;
        double momentum = 5.0 * 0.02 + 0.1 * toy->bodies[1].velocity[0] - 5.0 * 0.02, energy = 1.0;
        while (toy->time < 1.0) {
            double sum = 0.0, left = 0.0;
            toy_step(toy, 1e-4);
            for (int i = 0; i < 4; i++) {
                double v = toy->bodies[i].velocity[0];
                sum += toy->inertias[i].mass * v;
                left += 0.5 * toy->inertias[i].mass * v * v;
                if (i > 0) /* slower than rest_speed for a second, or one step of the fastest */
                    assert_true(toy->bodies[i].position[0] - toy->bodies[i - 1].position[0] >
                                0.02 - 1e-3);
            }
            near(sum, momentum, 1e-12 * 0.1);
            assert_true(left <= energy * (1.0 + 1e-12));
            energy = left;
        }
        impacts += toy->reports;
        assert_true(percuss_slow_counts(toy->slow).declared == toy->reports);
        toy_free(toy);
    }
    assert_true(impacts > 100); /* two or three where e is small, dozens where it is not */
}

static void bad_settings_are_named(void **state)
{
    (void)state;
    struct percuss_slow *slow;
    struct percuss_slow_config config = percuss_slow_config_default();
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_slow_error_text(), "body_count: 0"));
    config.body_count = 1;
    config.bodies = &(struct percuss_slow_body){.id = "sphere"};
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_slow_error_text(), "engine"));
    config.engine = (struct percuss_slow_engine){
        .probe = toy_probe, .apply = toy_apply, .now = toy_now, .push = toy_push};
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_slow_error_text(), "one of apply and push"));
    config.engine.apply = NULL;
    config.engine.apply_vector = toy_apply_vector;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    config.engine =
        (struct percuss_slow_engine){.probe = toy_probe, .apply = toy_apply, .now = toy_now};
    config.restitution = 1.5;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_slow_error_text(), "restitution: 1.5"));
    config.restitution = 0.5;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_OK);
    struct percuss_slow_contact self = {.a = 0, .b = 0};
    struct toy toy = {0};
    percuss_slow_free(slow);
    config.engine.context = &toy;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_OK);
    assert_int_equal(percuss_slow_advance(slow, 1, &self), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_slow_error_text(), "contacts[0]"));
    percuss_slow_free(slow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(asks_once_while_bodies_overlap),
        cmocka_unit_test(a_pair_and_its_bodies_are_pushed_alike),
        cmocka_unit_test(total_and_list_end_with_the_same_velocities),
        cmocka_unit_test(a_pair_that_goes_on_approaching_is_asked_about_again),
        cmocka_unit_test(the_order_of_a_pair_does_not_matter),
        cmocka_unit_test(trials_ask_nobody),
        cmocka_unit_test(coupled_contacts_are_one_question),
        cmocka_unit_test(a_fixed_body_does_not_couple),
        cmocka_unit_test(nothing_comes_from_nothing),
        cmocka_unit_test(bad_settings_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
