/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/slowscale/touch.c: steps of fixed length that end behind a touch, against closed
 * forms. The bodies are where they would be had the step been cut in two at the touch. */
#include "unit/slowscale/toy.h"

enum { BALL, FLOOR, THINGS };
enum integrator { EXACT, SYMPLECTIC, EXPLICIT };

static const double gravity = 9.81, mass = 0.1;

/* A ball on a plane that is tilted against gravity, in coordinates along and across it. */
struct drop {
    enum integrator integrator;
    double step, time, place[2], velocity[2], pull[2];
    size_t touches;
    double first; /* s: the first touch */
    char message[512];
};

static bool drop_probe(void *context, struct percuss_slow_view *view)
{
    const struct drop *drop = context;
    view->gap_rate[0] = drop->velocity[1];
    if (view->delassus)
        view->delassus[0] = 1.0 / mass;
    return true;
}

static bool drop_apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    struct drop *drop = context;
    (void)contact;
    drop->velocity[1] += impulse / mass;
    return true;
}

static bool drop_move(void *context, const struct percuss_slow_contact *contact, double moment)
{
    struct drop *drop = context;
    (void)contact;
    drop->place[1] += moment / mass;
    return true;
}

static double drop_now(void *context)
{
    return ((struct drop *)context)->time;
}

static void drop_report(void *context, const struct percuss_slow_report *report)
{
    struct drop *drop = context;
    if (!drop->touches++)
        drop->first = report->time;
    assert_true(fabs(report->contacts[0].gap) <= 1e-9); /* asked about at the touch */
    snprintf(drop->message, sizeof drop->message, "%s", report->message);
}

static void integrate(struct drop *drop)
{
    double h = drop->step;
    const double share[] = {[EXACT] = 0.5, [SYMPLECTIC] = 1.0, [EXPLICIT] = 0.0};
    for (int k = 0; k < 2; k++) {
        double change = -h * drop->pull[k];
        drop->place[k] += h * (drop->velocity[k] + share[drop->integrator] * change);
        drop->velocity[k] += change;
    }
    drop->time += h;
}

/* s, how much the engine's velocities are behind. */
static double lag_of(const struct drop *drop)
{
    const double steps[] = {[EXACT] = 0.0, [SYMPLECTIC] = 0.5, [EXPLICIT] = -0.5};
    return drop->step * steps[drop->integrator];
}

/* Of the path across the plane, J. */
static double energy(const struct drop *drop)
{
    double rate = drop->velocity[1] - drop->pull[1] * lag_of(drop);
    return mass * (0.5 * rate * rate + drop->pull[1] * drop->place[1]);
}

static struct percuss_slow *drop_start_lagging(struct drop *drop, double restitution, bool moves,
                                               double lag)
{
    static const struct percuss_slow_body names[THINGS] = {{.id = "ball"},
                                                           {.id = "floor", .fixed = true}};
    struct percuss_slow *slow;
    struct percuss_slow_config config = percuss_slow_config_default();
    config.body_count = THINGS;
    config.bodies = names;
    config.engine = (struct percuss_slow_engine){
        .context = drop, .probe = drop_probe, .apply = drop_apply, .now = drop_now};
    config.move = moves ? drop_move : NULL;
    config.velocity_lag = lag;
    config.restitution = restitution;
    config.report = moves ? drop_report : NULL;
    config.report_context = drop;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_OK);
    return slow;
}

static struct percuss_slow *drop_start(struct drop *drop, double restitution, bool moves)
{
    return drop_start_lagging(drop, restitution, moves, lag_of(drop));
}

static void go_on(struct drop *drop, struct percuss_slow *slow, double stated)
{
    integrate(drop);
    struct percuss_slow_contact contact = {.a = BALL,
                                           .b = FLOOR,
                                           .normal = {0.0, 0.0, 1.0},
                                           .gap = drop->place[1],
                                           .gap_acceleration = stated};
    if (percuss_slow_advance(slow, 1, &contact))
        fail_msg("%s", percuss_slow_error_text());
}

/* Drops a ball with 1 m/s at its touches and e = 1 until it has touched 20 times. */
static void bounce(enum integrator integrator, double flights, bool stated)
{
    const double speed = 1.0, flight = 2.0 * speed / gravity;
    struct drop drop = {.integrator = integrator,
                        .step = flight / flights,
                        .place = {0.0, 0.0},
                        .pull = {0.3, gravity}};
    drop.velocity[0] = 2.0;
    drop.velocity[1] = speed + gravity * lag_of(&drop);
    struct percuss_slow *slow = drop_start(&drop, 1.0, true);
    double before = energy(&drop);
    drop.place[1] = 1e-12; /* it leaves the floor, and does not touch it */
    while (drop.touches < 20)
        go_on(&drop, slow, stated ? -gravity : 0.0);
    /* 1e-12 s behind each touch is where it is asked about */
    near(energy(&drop), before, 1e-9 * before);
    double since = fmod(drop.time, flight);
    near(drop.place[1], since * (speed - 0.5 * gravity * since), 1e-9);
    near(drop.first, flight, 1e-10);
    assert_string_equal(drop.message, "");
    /* along the floor nothing happens */
    double path = drop.velocity[0] - drop.pull[0] * lag_of(&drop);
    near(path, 2.0 - 0.3 * (drop.time + lag_of(&drop)), 1e-12);
    percuss_slow_free(slow);
}

/* From many steps in a flight to four, and so that touches lie anywhere in them. */
static void a_ball_bounces_at_its_touches_whatever_the_steps(void **state)
{
    (void)state;
    static const double flights[] = {4.0, 4.3, 5.7, 11.9, 48.93, 203.7};
    for (size_t i = 0; i < sizeof flights / sizeof *flights; i++)
        for (int stated = 0; stated < 2; stated++) {
            bounce(EXACT, flights[i], stated);
            bounce(SYMPLECTIC, flights[i], stated);
            bounce(EXPLICIT, flights[i], stated);
        }
}

/* A lag that is not stated costs g h of speed at each bounce, one that is not there gives it: both
 * are told of. */
static void a_wrong_lag_is_told(void **state)
{
    (void)state;
    for (int there = 0; there < 2; there++) {
        struct drop drop = {.integrator = there ? SYMPLECTIC : EXACT,
                            .step = 0.01,
                            .place = {0.0, 0.05},
                            .pull = {0.0, gravity}};
        struct percuss_slow *slow = drop_start_lagging(&drop, 1.0, true, there ? 0.0 : 0.005);
        while (drop.touches < 1)
            go_on(&drop, slow, -gravity);
        assert_non_null(
            strstr(drop.message, "the gap of ball and floor moved as if its rates were "));
        assert_non_null(strstr(drop.message, there ? " 0.005 s old: config.velocity_lag is 0 s"
                                                   : " s old: config.velocity_lag is 0.005 s"));
        percuss_slow_free(slow);
    }
}

/* What it is for: the energy left after one bounce of a ball with e = 1 and four steps a flight. */
static void without_move_the_steps_take_energy(void **state)
{
    (void)state;
    struct drop drop = {.step = 0.05, .place = {0.0, 0.03}, .pull = {0.0, gravity}};
    struct percuss_slow *slow = drop_start(&drop, 1.0, false);
    double before = energy(&drop), lowest = 0.0;
    for (int i = 0; i < 2; i++) {
        go_on(&drop, slow, -gravity);
        lowest = fmin(lowest, drop.place[1]);
    }
    near(lowest, 0.03 - 0.5 * gravity * 0.01, 1e-12);
    near(drop.place[1], lowest, 0.0); /* it rises from down there: the 19 mm are left to it */
    near(energy(&drop), before, 1e-12);
    percuss_slow_free(slow);
}

/* An acceleration that is neither stated nor seen at two calls could be any: nothing is moved, and
 * no energy made. */
static void an_unknown_acceleration_is_not_guessed(void **state)
{
    (void)state;
    for (int stated = 0; stated < 2; stated++) {
        struct drop drop = {.step = 0.05, .place = {0.0, 0.01}, .pull = {0.0, gravity}};
        struct percuss_slow *slow = drop_start(&drop, 1.0, true);
        double end = 0.01 - 0.5 * gravity * 0.05 * 0.05, fall = sqrt(2.0 * 0.01 / gravity);
        if (!stated) {
            integrate(&drop);
            struct percuss_slow_contact contact = {
                .a = BALL, .b = FLOOR, .normal = {0.0, 0.0, 1.0}, .gap = drop.place[1]};
            /* drop_report would see the overlap */
            contact.gap = 0.0;
            assert_int_equal(percuss_slow_advance(slow, 1, &contact), PERCUSS_RESULT_OK);
            near(drop.place[1], end, 0.0);
            near(drop.first, 0.05, 0.0);
        } else {
            go_on(&drop, slow, -gravity);
            near(drop.first, fall, 1e-10);
            double up = 0.05 - fall;
            near(drop.place[1], up * (gravity * fall - 0.5 * gravity * up), 1e-10);
        }
        percuss_slow_free(slow);
    }
}

/* Three equal spheres in a row, 0.1 mm and 0.3 mm apart, e = 1: the first one's speed goes from one
 * to the next within a single step, each touch at its time. */
static void touches_within_a_step_come_in_their_order(void **state)
{
    (void)state;
    for (int flipped = 0; flipped < 2; flipped++) {
        struct percuss_slow_config wishes = percuss_slow_config_default();
        wishes.restitution = 1.0;
        wishes.move = toy_shift;
        struct toy *toy = toy_create(3, &wishes);
        toy->flips = flipped;
        toy->bodies[1].position[0] += 1e-4;
        toy->bodies[2].position[0] += 4e-4;
        toy->bodies[0].velocity[0] = 1.0;
        toy_step(toy, 0.0);
        toy_step(toy, 4e-6); /* rates are seen twice: nothing accelerates */
        toy_step(toy, 4e-3);
        near(toy->bodies[0].position[0], 1e-4, 1e-11);
        near(toy->bodies[1].position[0], 0.02 + 4e-4, 1e-11);
        near(toy->bodies[2].position[0], 0.04 + 4e-4 + 1.0 * (toy->time - 4e-4), 1e-11);
        near(toy->bodies[0].velocity[0], 0.0, 1e-14);
        near(toy->bodies[1].velocity[0], 0.0, 1e-14);
        near(toy->bodies[2].velocity[0], 1.0, 1e-14);
        assert_int_equal(toy->reports, 2);
        toy_free(toy);
    }
}

/* The service is asked about bodies that touch, with the velocities that they had then. */
static void the_question_is_that_of_the_touch(void **state)
{
    (void)state;
    struct percuss_slow_config wishes = toy_wishes();
    wishes.move = toy_shift;
    struct toy *toy = toy_create(2, &wishes);
    toy->answers = 1;
    toy->answer[0] = two_hits;
    toy->bodies[1].position[0] += 1e-4;
    toy_step(toy, 0.0);
    /* in the last step of 2 ms both are pulled: the first by 40 m/s^2 */
    toy_move(toy, 2e-3);
    toy->bodies[0].velocity[0] += 40.0 * 2e-3;
    toy->bodies[0].position[0] += 0.5 * 40.0 * 2e-3 * 2e-3;
    struct percuss_slow_contact contacts[TOY_BODIES];
    assert_int_equal(toy_contacts(toy, contacts), 1);
    contacts[0].gap_acceleration = -40.0;
    assert_int_equal(percuss_slow_advance(toy->slow, 1, contacts), PERCUSS_RESULT_OK);
    /* 0.1 mm = 0.2 t + 20 t^2 */
    double touch = (sqrt(0.04 + 80.0 * 1e-4) - 0.2) / 40.0;
    const struct percuss_request *question = &toy->question[0];
    const struct percuss_body_motion *first = &question->bodies[0], *second = &question->bodies[1];
    if (question->contacts[0].a == 0) { /* the first contact's a comes first */
        second = &question->bodies[0];
        first = &question->bodies[1];
    }
    near(second->position[0] - first->position[0], 0.02, 1e-11);
    near(question->contacts[0].point[0], first->position[0] + 0.01, 1e-11);
    near(second->velocity[0] - first->velocity[0], -0.2 - 40.0 * touch, 1e-9);
    near(question->contacts[0].gap, 0.0, 1e-11);
    near(question->contacts[0].gap_acceleration, -40.0, 0.0);
    /* the first sub-impact of 8 mN s has its centre 0.1 ms from then, and has been for the rest */
    double late = 2e-3 - touch - 1e-4;
    near(toy->bodies[1].position[0], 0.02 + 1e-4 + late * 0.08, 1e-10);
    near(toy->bodies[1].velocity[0], 0.08, 1e-14);
    toy_free(toy);
}

static void a_lag_without_a_number_is_refused(void **state)
{
    (void)state;
    struct percuss_slow_config config = toy_wishes();
    static const struct percuss_slow_body names[1] = {{.id = "ball"}};
    struct drop drop = {0};
    struct percuss_slow *slow;
    config.service.solve = NULL;
    config.body_count = 1;
    config.bodies = names;
    config.engine = (struct percuss_slow_engine){
        .context = &drop, .probe = drop_probe, .apply = drop_apply, .now = drop_now};
    config.velocity_lag = NAN;
    assert_int_equal(percuss_slow_create(&config, &slow), PERCUSS_RESULT_INVALID_ARGUMENT);
    assert_string_equal(percuss_slow_error_text(), "velocity_lag: nan: must be finite, s");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_bounces_at_its_touches_whatever_the_steps),
        cmocka_unit_test(a_wrong_lag_is_told),
        cmocka_unit_test(without_move_the_steps_take_energy),
        cmocka_unit_test(an_unknown_acceleration_is_not_guessed),
        cmocka_unit_test(touches_within_a_step_come_in_their_order),
        cmocka_unit_test(the_question_is_that_of_the_touch),
        cmocka_unit_test(a_lag_without_a_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
