/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/slowscale/slow.c, pairs.c and episode.c: one question an impact whatever the
 * bodies do meanwhile, lists and totals, latches, what is revoked, and what happens without an
 * answer. */
#include "unit/slowscale/toy.h"

/* Two hits: the first leaves the bodies approaching (e < 0 meanwhile), 5 ms later the second. */
static const struct toy_answer two_hits = {
    .window = 6e-3,
    .count = {2},
    .subs = {{{.start = 0.0, .compression_end = 1e-4, .end = 2e-4, .impulse = 0.008},
              {.start = 5e-3, .compression_end = 5.1e-3, .end = 5.2e-3, .impulse = 0.006}}},
};

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

/* Impulses that belong before the question, between two steps, or after the total was applied: the
 * bodies end where impulses at the centres of the forces would have brought them. */
static void impulses_out_of_their_time_move_the_bodies(void **state)
{
    (void)state;
    static const struct toy_answer answer = {
        .window = 4e-3,
        .count = {3},
        .subs = {{{.start = -3e-3, .compression_end = -2.9e-3, .end = -2.8e-3, .impulse = 0.004},
                  {.start = 1e-3, .compression_end = 1.2e-3, .end = 1.5e-3, .impulse = 0.006},
                  {.start = 3e-3, .compression_end = 3.1e-3, .end = 3.3e-3, .impulse = 0.005}}},
    };
    for (int way = 0; way < 3; way++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.application = way == 2 ? PERCUSS_SLOW_TOTAL : PERCUSS_SLOW_LIST;
        wishes.move = toy_shift;
        struct toy *toy = toy_create(2, &wishes);
        toy->answers = 1;
        toy->answer[0] = answer;
        double right = 0.0, momentum = 0.0;
        for (uint32_t i = 0; i < 3; i++) {
            struct percuss_sub_impact sub = answer.subs[0][i];
            sub.compression_impulse = 0.5 * sub.impulse;
            double centre = percuss_slow_force_centre(&sub);
            assert_true(i == 0 ? centre == sub.compression_end : centre > sub.compression_end);
            right += sub.impulse / 0.1 * (0.02 - centre);
            momentum += sub.impulse;
        }
        toy_step(toy, 0.0);
        if (way == 0)
            toy_run(toy, 0.02, 1e-3);
        for (int i = 0; way > 0 && i < 20; i++)
            toy_step(toy, 1e-3); /* stops nowhere */
        near(toy->time, 0.02, 1e-15);
        near(toy->bodies[1].position[0], 0.02 + right, 1e-15);
        near(toy->bodies[0].position[0], 0.2 * 0.02 - right, 1e-15);
        near(toy->applied[0], momentum, 1e-16);
        assert_string_equal(toy->message, "");
        toy_free(toy);
    }
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

/* A third body comes when half the list is played: the rest is revoked, the vibration of that
 * moment is asked for, and the new question holds both contacts. */
static void a_second_hit_revokes_the_list(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(3, &wishes);
    toy->bodies[2].position[0] += 4e-4;
    toy->bodies[2].velocity[0] = -0.1;
    toy->answers = 3;
    toy->answer[0] = two_hits;
    toy->answer[1] = (struct toy_answer){.truncated = true, .window = 2.3e-3, .count = {1}};
    toy->answer[2] = (struct toy_answer){
        .window = 1e-3,
        .count = {1, 1},
        .subs = {{{.start = 5e-4, .end = 7e-4, .compression_end = 6e-4, .impulse = 0.02}},
                 {{.end = 2e-4, .compression_end = 1e-4, .impulse = 0.03}}}};
    toy_step(toy, 0.0);
    while (toy->asked == 1 && toy->time < 5e-3)
        toy_step(toy, 1e-4);
    assert_int_equal(toy->asked, 3);
    near(toy->question[1].options.horizon, toy->time, 1e-12); /* from 0 to now */
    assert_int_equal(toy->question[1].contact_count, 1);
    assert_int_equal(toy->question[2].contact_count, 2);
    assert_string_equal(toy->question[2].bodies[0].state, "token-1-0");
    near(toy->question[2].bodies[0].elapsed, 0.0, 1e-12);
    assert_non_null(strstr(toy->message, "1 sub-impacts of the impact at 0 s revoked"));
    toy_run(toy, 0.02, 1e-4);
    near(toy->applied[0], 0.028, 1e-17); /* the second hit of the first list never came */
    near(toy->applied[1], 0.03, 1e-17);
    assert_true(percuss_slow_counts(toy->slow).preempted == 1);
    toy_free(toy);
}

/* The second body hits in the middle of a sub-impact, before or after its impulse was applied: all
 * is asked about from the start, as it was then, and applied once. */
static void a_sub_impact_under_way_is_asked_about_again(void **state)
{
    (void)state;
    for (int later = 0; later < 2; later++) {
        struct percuss_slow_config wishes = toy_wishes();
        struct toy *toy = toy_create(3, &wishes);
        double gap = later ? 30e-6 : 11e-6; /* outside group_gap */
        toy->bodies[2].position[0] += gap;
        toy->bodies[2].velocity[0] = -0.2; /* there after 0.055 ms, or after 0.13 ms */
        toy->answers = 2;
        toy->answer[0] = two_hits;
        toy->answer[1] = (struct toy_answer){
            .window = 6e-3,
            .count = {1, 1},
            .subs = {{{.compression_end = 1e-4, .end = 2e-4, .impulse = 0.03}},
                     {{.start = 5e-5, .compression_end = 1.5e-4, .end = 2.5e-4, .impulse = 0.03}}}};
        toy_step(toy, 0.0);
        toy_run(toy, 2e-2, 1e-5);
        assert_int_equal(toy->asked, 2);
        near(toy->question[1].contacts[0].gap, 0.0, 1e-15);
        near(toy->question[1].contacts[1].gap, gap, 1e-15);
        near(toy->question[1].bodies[1].velocity[0], 0.2, 1e-15); /* a of the first contact is s1 */
        near(toy->applied[0], 0.03, 1e-17);
        near(toy->applied[1], 0.03, 1e-17);
        assert_true(percuss_slow_counts(toy->slow).preempted == 0);
        toy_free(toy);
    }
}

/* Asked about again from its start, an impact has all of its impulses taken back, those too that
 * belong before its start: the new answer has them. */
static void what_lay_before_the_question_is_taken_back_with_it(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    wishes.move = toy_shift;
    struct toy *toy = toy_create(3, &wishes);
    toy->bodies[2].position[0] += 20e-6;
    toy->bodies[2].velocity[0] = -0.2;
    toy->answers = 2;
    toy->answer[0] = (struct toy_answer){
        .window = 6e-3,
        .count = {2},
        .subs = {{{.start = -3e-4, .compression_end = -2e-4, .end = -1e-4, .impulse = 0.001},
                  {.compression_end = 1e-4, .end = 2e-4, .impulse = 0.013}}}};
    toy->answer[1] = (struct toy_answer){
        .window = 6e-3,
        .count = {2, 1},
        .subs = {{{.start = -3e-4, .compression_end = -2e-4, .end = -1e-4, .impulse = 0.001},
                  {.compression_end = 1e-4, .end = 2e-4, .impulse = 0.029}},
                 {{.start = 5e-5, .compression_end = 1.5e-4, .end = 2.5e-4, .impulse = 0.03}}}};
    toy_step(toy, 0.0);
    near(toy->applied[0], 0.001, 1e-17);
    toy_run(toy, 2e-2, 1e-5);
    assert_int_equal(toy->asked, 2);
    near(toy->question[1].bodies[1].velocity[0], 0.2, 1e-15);
    near(toy->question[1].contacts[0].gap, 0.0, 1e-15);
    near(toy->question[1].contacts[1].gap, 20e-6, 1e-15);
    near(toy->applied[0], 0.03, 1e-17);
    near(toy->bodies[0].position[0], 0.2 * 0.02 - 0.01 * (0.02 + 2e-4) - 0.29 * (0.02 - 1e-4),
         1e-15);
    toy_free(toy);
}

static void an_unknown_state_is_asked_from_rest(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = 3;
    toy->answer[0] = toy->answer[2] = two_hits;
    toy->answer[1].status = PERCUSS_UNKNOWN_STATE;
    toy_step(toy, 0.0);
    toy_run(toy, 0.1, 1e-3);
    toy->bodies[0].position[0] = toy->bodies[1].position[0] - 0.02 + 1e-12;
    toy->bodies[0].velocity[0] = toy->bodies[1].velocity[0] + 0.1;
    toy_step(toy, 0.0);
    assert_int_equal(toy->asked, 3);
    assert_string_equal(toy->question[1].bodies[1].state, "token-0-1");
    assert_string_equal(toy->question[2].bodies[1].state, "");
    assert_true(toy->service_used);
    assert_non_null(strstr(toy->message, "without earlier vibration"));
    toy_free(toy);
}

static void without_an_answer_the_declared_value_is_used_with_leave(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    wishes.restitution = 0.4;
    wishes.fall_back = true;
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = 4;
    toy->answer[0].result = PERCUSS_RESULT_TIMEOUT;
    toy->answer[1].status = PERCUSS_BUSY;
    toy->answer[2] = toy->answer[3] = two_hits;
    toy->answer[2].truncated = toy->answer[2].spent = true;
    for (int i = 0; i < 4; i++) {
        toy->bodies[0].position[0] = toy->bodies[1].position[0] - 0.02 + 1e-12;
        toy->bodies[0].velocity[0] = toy->bodies[1].velocity[0] + 0.2;
        toy_step(toy, 0.0);
        assert_int_equal(toy->asked, i + 1);
        assert_true(toy->service_used == (i == 3));
        assert_true(toy->declared == (uint64_t)(i < 3 ? i + 1 : 3));
        near(toy->restitution[0], 0.4, 1e-12);
        if (i < 3)
            near(toy->bodies[1].velocity[0] - toy->bodies[0].velocity[0], 0.08, 1e-12);
        if (i == 0)
            assert_non_null(strstr(toy->message, "no answer: declared restitution 0.4 used"));
        if (i == 1)
            assert_non_null(strstr(toy->message, "BUSY"));
        toy_run(toy, toy->time + 0.05, 1e-3);
    }
    assert_true(percuss_slow_counts(toy->slow).declared == 3);
    toy_free(toy);
}

static enum percuss_result advance(struct toy *toy)
{
    struct percuss_slow_contact contacts[TOY_BODIES];
    size_t n = toy_contacts(toy, contacts);
    return percuss_slow_advance(toy->slow, n, contacts);
}

/* Nobody asked for a declared value: the impact does not happen until there is an answer, whatever
 * the reason, and then it is the answer it would have been. */
static void without_an_answer_nothing_happens_and_the_engine_may_try_again(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    const struct {
        enum percuss_result result;
        enum percuss_status status;
        enum percuss_result expected;
    } failures[] = {
        {PERCUSS_RESULT_TIMEOUT, PERCUSS_OK, PERCUSS_RESULT_TIMEOUT},
        {PERCUSS_RESULT_NO_SERVER, PERCUSS_OK, PERCUSS_RESULT_NO_SERVER},
        {PERCUSS_RESULT_OK, PERCUSS_BUSY, PERCUSS_RESULT_TIMEOUT},
        {PERCUSS_RESULT_OK, PERCUSS_UNSUPPORTED_GEOMETRY, PERCUSS_RESULT_INVALID_ARGUMENT},
    };
    const size_t count = sizeof failures / sizeof *failures;
    toy->answers = count + 1;
    for (size_t i = 0; i < count; i++) {
        toy->answer[i].result = failures[i].result;
        toy->answer[i].status = failures[i].status;
    }
    toy->answer[count] = two_hits;
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(advance(toy), failures[i].expected);
        assert_non_null(strstr(percuss_slow_error_text(), "impact of s1 and s0 at 0 s: "));
        assert_non_null(strstr(percuss_slow_error_text(), "config.fall_back"));
        near(toy->bodies[0].velocity[0], 0.2, 0.0);
        assert_int_equal(toy->reports, 0);
    }
    assert_int_equal(advance(toy), PERCUSS_RESULT_OK);
    toy_run(toy, 0.1, 1e-3);
    near(toy->bodies[0].velocity[0], 0.06, 1e-15);
    struct percuss_slow_counts counts = percuss_slow_counts(toy->slow);
    assert_true(counts.impacts == 1 && counts.requests == count + 1 && counts.declared == 0);
    toy_free(toy);
}

/* The same when a list was already revoked for the question: it is played on, and revoked again. */
static void a_list_that_could_not_be_replaced_goes_on(void **state)
{
    (void)state;
    double end[2][3];
    for (int failing = 0; failing < 2; failing++) {
        struct percuss_slow_config wishes = toy_wishes();
        struct toy *toy = toy_create(3, &wishes);
        toy->bodies[2].position[0] += 30e-6; /* there after 0.13 ms, in the middle of a hit */
        toy->bodies[2].velocity[0] = -0.2;
        toy->answers = 2 + (size_t)failing;
        toy->answer[0] = two_hits;
        toy->answer[1].result = PERCUSS_RESULT_TIMEOUT;
        toy->answer[1 + failing] = (struct toy_answer){
            .window = 6e-3,
            .count = {1, 1},
            .subs = {{{.compression_end = 1e-4, .end = 2e-4, .impulse = 0.03}},
                     {{.start = 5e-5, .compression_end = 1.5e-4, .end = 2.5e-4, .impulse = 0.03}}}};
        struct percuss_slow_contact contacts[TOY_BODIES];
        size_t failed = 0;
        toy_step(toy, 0.0);
        while (toy->time < 0.02) {
            double before = toy->bodies[0].velocity[0];
            toy_move(toy, 1e-5);
            size_t n = toy_contacts(toy, contacts);
            if (!percuss_slow_advance(toy->slow, n, contacts))
                continue;
            failed++;
            near(toy->bodies[0].velocity[0], before, 1e-15); /* taken back, and applied again */
            assert_false(isinf(percuss_slow_next(toy->slow)));
            assert_int_equal(percuss_slow_advance(toy->slow, n, contacts), PERCUSS_RESULT_OK);
        }
        assert_int_equal(failed, failing);
        assert_int_equal(toy->asked, 2 + failing);
        near(toy->applied[0], 0.03, 1e-17);
        near(toy->applied[1], 0.03, 1e-17);
        for (int i = 0; i < 3; i++)
            end[failing][i] = toy->bodies[i].velocity[0];
        toy_free(toy);
    }
    for (int i = 0; i < 3; i++)
        near(end[0][i], end[1][i], 1e-15);
}

/* A cut-off window is asked for again with four times the horizon. */
static void a_cut_off_window_is_not_final(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = 2;
    toy->answer[0] = two_hits;
    toy->answer[0].truncated = true;
    toy->answer[0].window = 4e-3;
    toy->answer[0].count[0] = 1;
    toy->answer[1] = two_hits;
    toy_step(toy, 0.0);
    assert_int_equal(toy->asked, 2);
    near(toy->question[1].options.horizon, 16e-3, 0.0);
    near(toy->restitution[0], 0.4, 1e-14);
    assert_string_equal(toy->message, "");
    toy_free(toy);
}

/* A wall that is hit on both sides at once does not carry one impact to the other. */
static void a_fixed_body_does_not_couple(void **state)
{
    (void)state;
    for (int fixed = 0; fixed < 2; fixed++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.bodies = (struct percuss_slow_body[]){{"s0", false}, {"wall", fixed}, {"s2", false}};
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
    config.bodies = &(struct percuss_slow_body){"sphere", false};
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_non_null(strstr(percuss_slow_error_text(), "engine"));
    config.engine = (struct percuss_slow_engine){NULL, toy_probe, toy_apply, toy_now};
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
        cmocka_unit_test(total_and_list_end_with_the_same_velocities),
        cmocka_unit_test(impulses_out_of_their_time_move_the_bodies),
        cmocka_unit_test(a_pair_that_goes_on_approaching_is_asked_about_again),
        cmocka_unit_test(the_order_of_a_pair_does_not_matter),
        cmocka_unit_test(trials_ask_nobody),
        cmocka_unit_test(coupled_contacts_are_one_question),
        cmocka_unit_test(a_second_hit_revokes_the_list),
        cmocka_unit_test(a_sub_impact_under_way_is_asked_about_again),
        cmocka_unit_test(what_lay_before_the_question_is_taken_back_with_it),
        cmocka_unit_test(an_unknown_state_is_asked_from_rest),
        cmocka_unit_test(without_an_answer_the_declared_value_is_used_with_leave),
        cmocka_unit_test(without_an_answer_nothing_happens_and_the_engine_may_try_again),
        cmocka_unit_test(a_list_that_could_not_be_replaced_goes_on),
        cmocka_unit_test(a_cut_off_window_is_not_final),
        cmocka_unit_test(a_fixed_body_does_not_couple),
        cmocka_unit_test(nothing_comes_from_nothing),
        cmocka_unit_test(bad_settings_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
