/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/slowscale/question.c and slowscale.c: what is asked again, and what happens
 * without an answer: with the user's leave the declared restitution, else nothing. */
#include "unit/slowscale/toy.h"

/* The bodies fly apart and meet again: the next impact. */
static void meet_again(struct toy *toy)
{
    toy_run(toy, toy->time + 0.1, 1e-3);
    toy->bodies[0].position[0] = toy->bodies[1].position[0] - 0.02 + 1e-12;
    toy->bodies[0].velocity[0] = toy->bodies[1].velocity[0] + 0.1;
    toy_step(toy, 0.0);
}

/* Nobody's change goes unseen: not after an impact without an answer, nor after one that did not
 * say; the same catalogue again is worth no word. */
static void another_catalogue_is_reported(void **state)
{
    (void)state;
    static const char soft[] = "70707070aaaaaaaa", stiff[] = "90909090bbbbbbbb";
    static const struct {
        const char *revision, *message;
        bool lost;
    } impacts[] = {
        {soft, "", false},
        {soft, "", false},
        {NULL, "no answer: declared restitution 0.5 used", true},
        {stiff, "answered with another catalogue (90909090) than before (70707070)", false},
        {stiff, "", false},
        {NULL, "", false},
        {soft, "answered with another catalogue (70707070) than before (90909090)", false},
    };
    enum { COUNT = sizeof impacts / sizeof *impacts };
    struct percuss_slow_config wishes = toy_wishes();
    wishes.fall_back = true;
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = COUNT;
    for (size_t i = 0; i < COUNT; i++) {
        toy->answer[i] = two_hits;
        toy->answer[i].revision = impacts[i].revision;
        toy->answer[i].result = impacts[i].lost ? PERCUSS_RESULT_NO_SERVER : PERCUSS_RESULT_OK;
    }
    for (size_t i = 0; i < COUNT; i++) {
        if (i == 0)
            toy_step(toy, 0.0);
        else
            meet_again(toy);
        assert_int_equal(toy->reports, i + 1);
        assert_string_equal(toy->message, impacts[i].message);
    }
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
    meet_again(toy);
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

/* Free bodies in the way of friction: the question has the coefficient and the tangent, and no
 * matrix; with one body that is not free it has the matrix and no friction, as ever. */
static void free_bodies_are_asked_about_with_friction(void **state)
{
    (void)state;
    static const struct percuss_slow_body bodies[] = {{.id = "s0", .free = true},
                                                      {.id = "s1", .free = true}};
    static const struct percuss_slow_body held[] = {{.id = "s0", .free = true}, {.id = "s1"}};
    for (int way = 0; way < 4; way++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.bodies = way == 2 ? held : bodies;
        wishes.engine.push = way == 1 ? toy_push : NULL;
        wishes.engine.apply_vector = way == 1 ? NULL : toy_apply_vector;
        wishes.options.friction = way == 3 ? PERCUSS_FRICTION_NONE : PERCUSS_FRICTION_PLAIN;
        struct toy *toy = toy_create(2, &wishes);
        toy->answers = 1;
        toy->answer[0] = two_hits;
        toy->friction = way == 2 ? 0.0 : 0.3;
        toy->tangent[2] = 1.0;
        toy_step(toy, 0.0);
        const struct percuss_request *question = &toy->question[0];
        bool rubs = way < 2;
        assert_true((question->delassus == NULL) == rubs);
        assert_int_equal(question->options.friction,
                         rubs ? PERCUSS_FRICTION_PLAIN : PERCUSS_FRICTION_NONE);
        near(question->contacts[0].friction, rubs ? 0.3 : 0.0, 0.0);
        near(question->contacts[0].tangent[2], rubs ? 1.0 : 0.0, 0.0);
        if (!rubs)
            near(toy->matrix[0][0], 20.0, 1e-12);
        toy_free(toy);
    }
}

/* With the engine's matrix of normals and tangents no body need be free: the question has that
 * matrix, in the order of its contacts, and states the tangents. */
static void bodies_in_joints_are_asked_about_with_friction(void **state)
{
    (void)state;
    for (int way = 0; way < 3; way++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.engine.apply_vector = toy_apply_vector;
        wishes.engine.oblique = toy_oblique;
        wishes.options.friction = way == 2 ? PERCUSS_FRICTION_NONE : PERCUSS_FRICTION_MICRO_SLIP;
        struct toy *toy = toy_create(3, &wishes);
        toy->answers = 1;
        toy->answer[0] = two_hits;
        toy->answer[0].count[1] = 1;
        toy->friction = way == 1 ? 0.0 : 0.3;
        toy->tangent[0] = way == 1 ? 0.0 : 3.0;
        toy->tangent[2] = way == 1 ? 0.0 : -2.0;
        toy_step(toy, 0.0);
        const struct percuss_request *question = &toy->question[0];
        const double *w = toy->matrix[0];
        assert_int_equal(question->contact_count, 2);
        assert_int_equal(question->options.friction, wishes.options.friction);
        if (way == 2) {
            assert_int_equal(question->delassus_rows, 0);
            near(w[1], -10.0, 1e-12);
            toy_free(toy);
            continue;
        }
        /* 1/m + 1/m along the normals; 1/m + r^2/I twice along the tangents; the sphere between
         * both contacts carries an impulse on, less what it turns it by */
        assert_int_equal(question->delassus_rows, 6);
        for (int i = 0; i < 2; i++) {
            near(question->contacts[i].friction, toy->friction, 0.0);
            /* along the surface: of x = normal the part is gone; else the first axis across it */
            near(question->contacts[i].tangent[way == 1 ? 1 : 2], way == 1 ? 1.0 : -1.0, 1e-15);
            for (int k = 0; k < 3; k++) {
                near(w[(3 * i + k) * 7], k == 0 ? 20.0 : 70.0, 1e-10);
                near(w[k * 6 + 3 + k], k == 0 ? -10.0 : 15.0, 1e-10);
                near(w[(3 + k) * 6 + k], k == 0 ? -10.0 : 15.0, 1e-10);
            }
            near(w[3 * i * 6 + 3 * i + 1], 0.0, 1e-12);
        }
        toy_free(toy);
    }
}

static bool reverse_rows(void *context, size_t count, const struct percuss_slow_contact *contacts,
                         double *delassus)
{
    double w[9];
    toy_oblique(context, count, contacts, w);
    for (int i = 0; i < 9; i++)
        delassus[i] = w[8 - i];
    return true;
}

static bool fail_oblique(void *context, size_t count, const struct percuss_slow_contact *contacts,
                         double *delassus)
{
    (void)context, (void)count, (void)contacts, (void)delassus;
    return false;
}

/* Rows in another order and a failure end the call; contacts beyond what a matrix holds have no
 * friction. */
static void a_bad_matrix_of_tangents_is_found_out(void **state)
{
    (void)state;
    static struct percuss_slow_contact many[22];
    struct percuss_slow_config wishes = toy_wishes();
    wishes.engine.apply_vector = toy_apply_vector;
    for (int way = 0; way < 3; way++) {
        wishes.engine.oblique = way == 0 ? reverse_rows : way == 1 ? fail_oblique : toy_oblique;
        struct toy *toy = toy_create(2, &wishes);
        const char *text =
            way == 0   ? "oblique: [0][0]: 70: the engine's probe has 20 1/kg for the normal"
            : way == 1 ? "the engine's oblique failed"
                       : "friction: 0.3: s1 is not stated to be free, and the engine's oblique "
                         "serves at most 21 contacts";
        toy->friction = 0.3;
        toy_contacts(toy, many);
        for (uint32_t i = 1; way == 2 && i < 22; i++) {
            many[i] = many[0];
            many[i].feature = i;
        }
        assert_int_equal(percuss_slow_advance(toy->slow, way == 2 ? 22 : 1, many),
                         PERCUSS_RESULT_INVALID_ARGUMENT);
        if (!strstr(percuss_slow_error_text(), text))
            fail_msg("%s", percuss_slow_error_text());
        assert_int_equal(toy->asked, 0);
        near(toy->bodies[0].velocity[0], 0.2, 0.0);
        toy_free(toy);
    }
}

/* A coefficient that would be dropped is refused, and so are bodies of other masses; nothing has
 * happened then. */
static void friction_that_cannot_be_is_refused_by_name(void **state)
{
    (void)state;
    static const struct {
        struct percuss_slow_body bodies[2];
        bool scalar; /* the engine takes impulses along normals alone */
        double inverse_mass;
        const char *text;
    } cases[] = {
        {{{.id = "s0", .free = true}, {.id = "s1"}},
         false,
         0.0,
         "contact of s1 and s0: friction: 0.3: s1 is not stated to be free, and the engine "
         "gives no oblique: 0, or options.friction none, is allowed"},
        {{{.id = "s0", .fixed = true}, {.id = "s1", .fixed = true}},
         false,
         0.0,
         "s0 is fixed, and so is the other one"},
        {{{.id = "s0", .free = true}, {.id = "s1", .free = true}},
         true,
         0.0,
         "friction: 0.3: the engine must give apply_vector or push"},
        {{{.id = "s0", .free = true}, {.id = "s1", .free = true}},
         false,
         19.5,
         "the inverse effective mass is 20 1/kg in the engine and 19.5 1/kg in the catalogue"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.bodies = cases[i].bodies;
        wishes.engine.apply_vector = cases[i].scalar ? NULL : toy_apply_vector;
        struct toy *toy = toy_create(2, &wishes);
        toy->answers = 1;
        toy->answer[0] = two_hits;
        toy->answer[0].inverse_mass = cases[i].inverse_mass;
        toy->friction = 0.3;
        assert_int_equal(advance(toy), PERCUSS_RESULT_INVALID_ARGUMENT);
        if (!strstr(percuss_slow_error_text(), cases[i].text))
            fail_msg("%s", percuss_slow_error_text());
        near(toy->bodies[0].velocity[0], 0.2, 0.0);
        toy_free(toy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(another_catalogue_is_reported),
        cmocka_unit_test(an_unknown_state_is_asked_from_rest),
        cmocka_unit_test(without_an_answer_the_declared_value_is_used_with_leave),
        cmocka_unit_test(without_an_answer_nothing_happens_and_the_engine_may_try_again),
        cmocka_unit_test(a_list_that_could_not_be_replaced_goes_on),
        cmocka_unit_test(a_cut_off_window_is_not_final),
        cmocka_unit_test(free_bodies_are_asked_about_with_friction),
        cmocka_unit_test(bodies_in_joints_are_asked_about_with_friction),
        cmocka_unit_test(a_bad_matrix_of_tangents_is_found_out),
        cmocka_unit_test(friction_that_cannot_be_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
