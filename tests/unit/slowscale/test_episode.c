/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/slowscale/episode.c: impulses at their times, whenever they are
 * applied, and answers that are revoked because another body hits. */
#include "unit/slowscale/toy.h"

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

/* Two hits of spheres that slide on each other, mu = 0.3, and the friction of the second reverses:
 * both get the spin P_t R / I from the whole impulse, however it is applied and with the bodies the
 * other way round at every look; momenta are kept. */
static void friction_spins_the_bodies(void **state)
{
    (void)state;
    static const struct percuss_slow_body bodies[] = {{.id = "s0", .free = true},
                                                      {.id = "s1", .free = true}};
    const double mu = 0.3, moment = 4e-6, radius = 0.01;
    for (int way = 0; way < 8; way++) {
        struct percuss_slow_config wishes = toy_wishes();
        wishes.bodies = bodies;
        wishes.application = way & 1 ? PERCUSS_SLOW_TOTAL : PERCUSS_SLOW_LIST;
        wishes.engine.push = way & 2 ? toy_push : NULL;
        wishes.engine.apply_vector = way & 2 ? NULL : toy_apply_vector;
        wishes.move_vector = way & 1 ? toy_shift_vector : NULL;
        struct toy *toy = toy_create(2, &wishes);
        toy->flips = way & 4;
        toy->friction = mu;
        toy->bodies[0].velocity[1] = 1.0; /* a, s1, is dragged along y */
        toy->answers = 1;
        toy->answer[0] = two_hits;
        toy->answer[0].friction = mu;
        for (int i = 0; i < 2; i++) {
            struct percuss_sub_impact *sub = &toy->answer[0].subs[0][i];
            sub->impulse_tangential[0] = (i == 0 ? mu : -0.5 * mu) * sub->impulse;
            sub->compression_impulse = 0.5 * sub->impulse; /* as the service answers */
        }
        const double middle[3] = {0.01, 0.0, 0.0};
        double momentum = toy_momentum(toy->bodies, toy->inertias, 2, middle);
        double places[2][3];
        for (int i = 0; i < 2; i++)
            memcpy(places[i], toy->bodies[i].position, sizeof places[i]);
        toy_step(toy, 0.0);
        if (!(way & 1))
            toy_run(toy, 0.02, 1e-3);
        const double total = 0.014, dragged = mu * (0.008 - 0.5 * 0.006);
        near(toy->bodies[1].velocity[1], dragged / 0.1, 1e-15);
        near(toy->bodies[0].velocity[1], 1.0 - dragged / 0.1, 1e-15);
        near(toy->bodies[1].velocity[0], total / 0.1, 1e-15);
        /* of a list, the second hit comes when the spheres overlap: its arms are 1 % shorter */
        bool at_once = way & 1;
        if (at_once) {
            /* at its later time an impulse would have moved them less by now */
            double late = 0.0, beside = 0.0;
            for (int i = 0; i < 2; i++) {
                const struct percuss_sub_impact *sub = &toy->answer[0].subs[0][i];
                late -= sub->impulse * percuss_slow_force_centre(sub);
                beside -= sub->impulse_tangential[0] * percuss_slow_force_centre(sub);
            }
            near(toy->bodies[1].position[1], beside / 0.1, 1e-15);
            near(toy->bodies[1].position[0], 0.02 + late / 0.1, 1e-15);
            for (int i = 0; i < 2; i++)
                memcpy(toy->bodies[i].position, places[i], sizeof places[i]);
            near(toy_momentum(toy->bodies, toy->inertias, 2, middle), momentum, 1e-15);
        }
        for (int i = 0; i < 2; i++)
            near_relative(toy->bodies[i].angular_velocity[2], -dragged * radius / moment,
                          at_once ? 1e-12 : 0.01);
        assert_true(toy->bodies[0].angular_velocity[0] == 0.0);
        toy_free(toy);
    }
}

/* A third body hits in the midst of a list with friction: what is asked about the vibration then
 * has the first question's matrix, or none either, the tangential impulse that was applied is taken
 * back, and both are in the new answer. */
static void friction_is_revoked_with_its_list(void **state)
{
    (void)state;
    static const struct percuss_slow_body bodies[] = {
        {.id = "s0", .free = true}, {.id = "s1", .free = true}, {.id = "s2", .free = true}};
    for (int way = 0; way < 4; way++) {
        bool later = way & 1, joints = way & 2;
        struct percuss_slow_config wishes = toy_wishes();
        wishes.bodies = joints ? NULL : bodies;
        wishes.engine.oblique = joints ? toy_oblique : NULL;
        wishes.engine.push = toy_push;
        struct toy *toy = toy_create(3, &wishes);
        /* in the midst of the first hit, with its impulse applied; or between both */
        toy->bodies[2].position[0] += later ? 4e-4 : 30e-6;
        toy->bodies[2].velocity[0] = later ? -0.1 : -0.2;
        toy->answers = 2 + (size_t)later;
        toy->answer[0] = two_hits;
        toy->answer[0].friction = 0.3;
        toy->answer[0].subs[0][0].impulse_tangential[0] = 0.002;
        toy->answer[0].subs[0][1].impulse_tangential[0] = 0.001;
        toy->answer[1] = (struct toy_answer){.truncated = true, .window = 2.3e-3, .count = {1}};
        toy->answer[1 + later] = (struct toy_answer){
            .window = 6e-3,
            .friction = 0.3,
            .count = {1, 1},
            .subs = {{{.compression_end = 1e-4,
                       .end = 2e-4,
                       .impulse = 0.03,
                       .impulse_tangential = {0.005, 0.0}}},
                     {{.start = 5e-5, .compression_end = 1.5e-4, .end = 2.5e-4, .impulse = 0.03}}}};
        toy_step(toy, 0.0);
        toy_run(toy, 2e-2, 1e-5);
        assert_int_equal(toy->asked, toy->answers);
        for (size_t i = 0; i < toy->asked; i++) {
            assert_true((toy->question[i].delassus != NULL) == joints);
            assert_int_equal(toy->question[i].delassus_rows,
                             joints ? 3 * toy->question[i].contact_count : 0);
            if (joints)
                near(toy->matrix[i][0], 20.0, 1e-12);
            if (joints && toy->question[i].contact_count == 1)
                near(toy->matrix[i][4], 70.0, 1e-10);
            assert_int_equal(toy->question[i].options.friction, PERCUSS_FRICTION_MICRO_SLIP);
        }
        double dragged = later ? 0.002 + 0.005 : 0.005;
        near(toy->bodies[0].velocity[1], -dragged / 0.1, 1e-15);
        near(toy->bodies[1].velocity[1], dragged / 0.1, 1e-15);
        near(toy->bodies[2].velocity[1], 0.0, 0.0);
        toy_free(toy);
    }
}

/* The surface has turned when the second hit is played: its tangential part lies in the surface as
 * it is by then, of the size that it has. */
static void friction_turns_with_the_surface(void **state)
{
    (void)state;
    static const struct percuss_slow_body bodies[] = {{.id = "s0", .free = true},
                                                      {.id = "s1", .free = true}};
    const double tilt = 0.05;
    struct percuss_slow_config wishes = toy_wishes();
    wishes.bodies = bodies;
    wishes.engine.apply_vector = toy_apply_vector;
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = 1;
    toy->answer[0] = two_hits;
    toy->answer[0].friction = 0.3;
    toy->answer[0].subs[0][1].impulse_tangential[1] = 0.001; /* along z */
    toy_step(toy, 0.0);
    toy_run(toy, 1e-3, 1e-4);
    const double before[3] = {0.08, 0.0, 0.0};
    for (int k = 0; k < 3; k++)
        near(toy->bodies[1].velocity[k], before[k], 1e-15);
    toy->tilt = tilt;
    toy_run(toy, 0.02, 1e-3);
    near(toy->bodies[1].velocity[0], 0.08 + 0.06 * cos(tilt) - 0.01 * sin(tilt), 1e-15);
    near(toy->bodies[1].velocity[2], 0.06 * sin(tilt) + 0.01 * cos(tilt), 1e-15);
    near(toy->bodies[1].velocity[1], 0.0, 0.0);
    toy_free(toy);
}

/* An engine of three coordinates with M = 1/20: a force along direction d at contact i pushes them
 * along d_x row[i][0] + d_y row[i][1] + d_z row[i][2]; the first row is that of the gap. */
struct abstract {
    double time, q[3], rate[3], row[2][3][3], gap[2];
    size_t asked;
    double gaps[2]; /* of the last question */
    struct percuss_sub_impact sub;
    struct percuss_contact_result result[2];
};

static double along(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool abstract_oblique(void *context, size_t count,
                             const struct percuss_slow_contact *contacts, double *delassus)
{
    const struct abstract *engine = context;
    size_t rows = 3 * count;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < rows; j++)
            delassus[i * rows + j] = 20.0 * along(engine->row[contacts[i / 3].feature][i % 3],
                                                  engine->row[contacts[j / 3].feature][j % 3]);
    return true;
}

static bool abstract_probe(void *context, struct percuss_slow_view *view)
{
    const struct abstract *engine = context;
    for (size_t i = 0; i < view->count; i++) {
        const double *of = engine->row[view->contacts[i].feature][0];
        view->gap_rate[i] = along(of, engine->rate);
        for (size_t j = 0; view->delassus && j < view->count; j++)
            view->delassus[i * view->count + j] =
                20.0 * along(of, engine->row[view->contacts[j].feature][0]);
    }
    return true;
}

static bool abstract_apply(void *context, const struct percuss_slow_contact *contact,
                           const double impulse[3])
{
    struct abstract *engine = context;
    for (int d = 0; d < 3; d++)
        for (int k = 0; k < 3; k++)
            engine->rate[k] += 20.0 * impulse[d] * engine->row[contact->feature][d][k];
    return true;
}

static double abstract_now(void *context)
{
    return ((struct abstract *)context)->time;
}

static enum percuss_result abstract_solve(void *context, const struct percuss_request *request,
                                          struct percuss_reply *reply)
{
    struct abstract *engine = context;
    engine->asked++;
    reply->complete = true;
    reply->window = 1e-3;
    reply->contacts = engine->result;
    reply->contact_count = request->contact_count;
    for (size_t i = 0; i < request->contact_count; i++) {
        engine->gaps[i] = request->contacts[i].gap;
        engine->result[i] = (struct percuss_contact_result){.impulse = engine->sub.impulse,
                                                            .end_time = engine->sub.end,
                                                            .friction = 0.3,
                                                            .tangent = {0.0, 1.0, 0.0},
                                                            .sub_impact_count = 1,
                                                            .sub_impacts_listed = 1,
                                                            .sub_impacts = &engine->sub};
        memcpy(engine->result[i].impulse_tangential, engine->sub.impulse_tangential,
               sizeof engine->result[i].impulse_tangential);
    }
    return PERCUSS_RESULT_OK;
}

static void abstract_release(struct percuss_reply *reply)
{
    *reply = (struct percuss_reply){0};
}

/* Friction changes the gaps' rates where joints couple the directions: an impulse that is taken
 * back takes with it what its tangential part has done to the gaps, so that the new question has
 * those of its own instant. */
static void friction_that_is_taken_back_leaves_no_gap(void **state)
{
    (void)state;
    static const struct percuss_slow_body bodies[] = {{.id = "a"}, {.id = "b"}, {.id = "c"}};
    static struct abstract engine = {.rate = {-0.2, 0.0, -0.1},
                                     .row = {{{1.0, 0.0, 0.0}, {0.6, 0.8, 0.0}, {0.1, -0.3, 0.2}},
                                             {{-0.5, 0.4, 0.9}, {0.3, 0.2, -0.7}, {0.2, 0.9, 0.1}}},
                                     .gap = {0.0, 30e-6},
                                     .sub = {.compression_end = 1e-4,
                                             .end = 4e-4,
                                             .impulse = 0.03,
                                             .compression_impulse = 0.015,
                                             .impulse_tangential = {0.01, -0.02}}};
    struct percuss_slow_config config = percuss_slow_config_default();
    struct percuss_slow *slow;
    config.body_count = 3;
    config.bodies = bodies;
    config.engine = (struct percuss_slow_engine){.context = &engine,
                                                 .probe = abstract_probe,
                                                 .now = abstract_now,
                                                 .apply_vector = abstract_apply,
                                                 .oblique = abstract_oblique};
    config.service = (struct percuss_slow_service){&engine, abstract_solve, abstract_release, NULL};
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_OK);
    for (int i = 0; i < 1000 && engine.asked < 2; i++) {
        struct percuss_slow_contact contacts[2] = {{.a = 1, .b = 0}, {.a = 2, .b = 1}};
        for (uint32_t c = 0; c < 2; c++) {
            contacts[c].feature = c;
            contacts[c].normal[0] = contacts[c].tangent[1] = 1.0;
            contacts[c].gap = engine.gap[c] + along(engine.row[c][0], engine.q);
        }
        if (percuss_slow_advance(slow, 2, contacts))
            fail_msg("%s", percuss_slow_error_text());
        /* to the impulse's instant, and on until the second contact closes while it is under way */
        double dt = fmin(1e-6, percuss_slow_next(slow) - engine.time);
        engine.time += dt;
        for (int k = 0; k < 3; k++)
            engine.q[k] += dt * engine.rate[k];
    }
    assert_int_equal(engine.asked, 2);
    assert_true(engine.time > 2e-4 && engine.time < 4e-4);
    near(engine.gaps[0], 0.0, 1e-15);
    near(engine.gaps[1], 30e-6, 1e-15);
    percuss_slow_free(slow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impulses_out_of_their_time_move_the_bodies),
        cmocka_unit_test(a_second_hit_revokes_the_list),
        cmocka_unit_test(a_sub_impact_under_way_is_asked_about_again),
        cmocka_unit_test(what_lay_before_the_question_is_taken_back_with_it),
        cmocka_unit_test(friction_spins_the_bodies),
        cmocka_unit_test(friction_is_revoked_with_its_list),
        cmocka_unit_test(friction_turns_with_the_surface),
        cmocka_unit_test(friction_that_is_taken_back_leaves_no_gap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
