/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors client/slowscale/pairs.c: a ball under gravity on the ground with a declared restitution,
 * for steps and restitutions of every size, two integrators, with and without event location and
 * `move`. It never falls through, the slow scale never adds energy, and in the end the ball lies on
 * the engine's own contact. */
#include "unit/slowscale/toy.h"

enum { BALL, GROUND, THINGS };
enum contact_of_engine { NO_CONTACT, STOP, SPRING };

static const double gravity = 9.81, mass = 0.1;

/* How an engine goes about it. */
struct manner {
    double step, restitution;
    bool symplectic, locates, says_acceleration, moves, flips;
    enum contact_of_engine contact;
};

struct drop {
    struct manner manner;
    double time, gap, speed;
    double lag; /* s, of the speed, where the slow scale is told */
    struct percuss_slow *slow;
    size_t impacts;
};

static bool drop_probe(void *context, struct percuss_slow_view *view)
{
    const struct drop *drop = context;
    view->gap_rate[0] = drop->speed;
    if (view->delassus)
        view->delassus[0] = 1.0 / mass;
    return true;
}

static bool drop_apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    struct drop *drop = context;
    (void)contact;
    drop->speed += impulse / mass;
    return true;
}

static bool drop_move(void *context, const struct percuss_slow_contact *contact, double moment)
{
    struct drop *drop = context;
    (void)contact;
    drop->gap += moment / mass;
    return true;
}

static double drop_now(void *context)
{
    return ((struct drop *)context)->time;
}

static void drop_report(void *context, const struct percuss_slow_report *report)
{
    struct drop *drop = context;
    (void)report;
    drop->impacts++;
}

static struct percuss_slow_contact contact_of(const struct drop *drop)
{
    struct percuss_slow_contact contact = {.a = BALL, .b = GROUND, .normal = {0.0, 0.0, 1.0}};
    if (drop->manner.flips && lround(drop->time / drop->manner.step) % 2)
        contact = (struct percuss_slow_contact){.a = GROUND, .b = BALL, .normal = {0.0, 0.0, -1.0}};
    contact.gap = drop->gap;
    contact.gap_acceleration = drop->manner.says_acceleration ? -gravity : 0.0;
    return contact;
}

/* One step of the engine; its own contact is on where the slow scale says that the ball rests. */
static void integrate(struct drop *drop, double h)
{
    const double frequency = 0.5 / drop->manner.step; /* of a spring, critically damped */
    double old = drop->speed, force = 0.0;
    bool rests = percuss_slow_rests(drop->slow, BALL, GROUND, 0);
    if (rests && drop->manner.contact == SPRING && drop->gap < 0.0)
        force = fmax(0.0, -frequency * (frequency * drop->gap + 2.0 * drop->speed));
    drop->speed += h * (force - gravity);
    if (rests && drop->manner.contact == STOP && drop->gap <= 0.0)
        drop->speed = fmax(drop->speed, 0.0);
    drop->gap += h * (drop->manner.symplectic ? drop->speed : old);
    drop->time += h;
}

static double energy(const struct drop *drop)
{
    double rate = drop->speed - gravity * drop->lag; /* of the path */
    return mass * (0.5 * rate * rate + gravity * drop->gap);
}

static bool is_due(const struct drop *drop)
{
    struct percuss_slow_contact contact = contact_of(drop);
    return percuss_slow_due(drop->slow, 1, &contact);
}

/* One accepted step. */
static void go_on(struct drop *drop)
{
    struct drop start = *drop;
    double before = 0.0, after = drop->manner.step;
    integrate(drop, after);
    if (drop->manner.locates && is_due(drop)) {
        while (after - before > 1e-15) {
            double middle = 0.5 * (before + after);
            *drop = start;
            integrate(drop, middle);
            *(is_due(drop) ? &after : &before) = middle;
        }
        *drop = start;
        integrate(drop, after);
    }
    struct percuss_slow_contact contact = contact_of(drop);
    double came = energy(drop);
    if (percuss_slow_advance(drop->slow, 1, &contact))
        fail_msg("%s", percuss_slow_error_text());
    assert_true(energy(drop) <= came + 1e-14);
}

static struct drop *drop_create(const struct manner *manner, double gap, double rest_speed)
{
    static const struct percuss_slow_body names[THINGS] = {{.id = "ball"},
                                                           {.id = "ground", .fixed = true}};
    struct drop *drop = calloc(1, sizeof *drop);
    assert_non_null(drop);
    *drop = (struct drop){.manner = *manner, .gap = gap};
    struct percuss_slow_config config = percuss_slow_config_default();
    config.body_count = THINGS;
    config.bodies = names;
    config.engine = (struct percuss_slow_engine){
        .context = drop, .probe = drop_probe, .apply = drop_apply, .now = drop_now};
    config.move = manner->moves ? drop_move : NULL;
    /* steps that are cut short at the touch have no constant lag */
    if (manner->moves && !manner->locates)
        drop->lag = (manner->symplectic ? 0.5 : -0.5) * manner->step;
    config.velocity_lag = drop->lag;
    config.restitution = manner->restitution;
    if (rest_speed > 0.0)
        config.rest_speed = rest_speed;
    config.report = drop_report;
    config.report_context = drop;
    assert_int_equal(percuss_slow_create(&config, &drop->slow), PERCUSS_RESULT_OK);
    return drop;
}

static void drop_free(struct drop *drop)
{
    percuss_slow_free(drop->slow);
    free(drop);
}

/* An explicit step moves with the old velocity: the engine's positions rebound faster than it
 * reports by g h / 2, and come back slower. In the end every impact takes what the engine brings.
 */
static double endless_speed(const struct manner *manner)
{
    double e = manner->restitution;
    return manner->symplectic ? 0.0 : 0.5 * (1.0 + e) / (1.0 - e) * gravity * manner->step;
}

/* Drops the ball and watches it until it must have come to rest. */
static void watch(const struct manner *manner)
{
    const double height = 5e-3, h = manner->step;
    const double fastest = sqrt(2.0 * gravity * height) + endless_speed(manner);
    struct drop *drop = drop_create(manner, height, 0.0);
    double lowest = 0.0, end = 1.0 + 4.0 * fastest / (gravity * (1.0 - manner->restitution));
    double most = energy(drop);
    while (drop->time < end) {
        go_on(drop);
        lowest = fmin(lowest, drop->gap);
        /* what an explicit step of free flight brings is the engine's own error */
        most += manner->symplectic ? 0.0 : 0.5 * mass * gravity * gravity * h * h;
        if (!(energy(drop) <= most + 1e-12))
            fail_msg("energy %g J of %g at %g s", energy(drop), most, drop->time);
    }
    /* the overlap of one step at the fastest, and of two steps until the engine's contact holds: at
     * 3 g h, or from within group_gap. A spring gives by g / frequency^2 = 4 g h^2 and overshoots
     */
    double allowed = (manner->locates ? 0.0 : h * (fastest + gravity * h)) +
                     (manner->contact == SPRING ? 20.0 : 6.0) * gravity * h * h +
                     2.0 * h * sqrt(2.0 * gravity * 1e-5);
    if (!(lowest >= -allowed))
        fail_msg("step %g s, e %g: fell %g m through the ground", h, manner->restitution, -lowest);
    /* An explicit engine lets it lie only where that is told from a flight, which takes the
     * acceleration, and where the engine does not make it fly for more than three steps. */
    bool can_rest = manner->symplectic ||
                    (manner->says_acceleration && endless_speed(manner) <= 1.5 * gravity * h);
    bool rests = percuss_slow_rests(drop->slow, GROUND, BALL, 0);
    if (can_rest ? !rests || fabs(drop->speed) > 1e-3
                 : fabs(drop->speed) > endless_speed(manner) + 2.0 * gravity * h)
        fail_msg("step %g s, e %g, %s%s: %g m/s in the end", h, manner->restitution,
                 manner->symplectic ? "symplectic" : "explicit", rests ? ", rests" : "",
                 drop->speed);
    drop_free(drop);
}

static const double steps[] = {0.4e-3, 1e-3, 2.5e-3, 5e-3};
static const double coefficients[] = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95};

static void a_bouncing_ball_never_falls_through_the_ground(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        for (size_t j = 0; j < sizeof coefficients / sizeof *coefficients; j++)
            for (int k = 0; k < 32; k++)
                watch(&(struct manner){.step = steps[i],
                                       .restitution = coefficients[j],
                                       .symplectic = k & 1,
                                       .locates = k & 2,
                                       .says_acceleration = k & 4,
                                       .moves = k & 8,
                                       .flips = (i + j) & 1,
                                       .contact = k & 16 ? SPRING : STOP});
}

/* A slow impact is one, however long the steps: only what lay together before can rest. */
static void a_slow_approach_from_afar_is_an_impact(void **state)
{
    (void)state;
    const struct manner manner = {
        .step = 5e-3, .restitution = 0.5, .symplectic = true, .says_acceleration = true};
    for (int given = 0; given < 2; given++) {
        struct drop *drop = drop_create(&manner, 3e-4, given ? 0.08 : 0.0);
        struct percuss_slow_contact contact = contact_of(drop);
        drop->speed = -0.02;
        assert_int_equal(percuss_slow_advance(drop->slow, 1, &contact), PERCUSS_RESULT_OK);
        go_on(drop); /* with 0.069 m/s: less than 1.5 g h, but it did not lie there before */
        assert_true(drop->gap < 0.0);
        assert_int_equal(drop->impacts, !given); /* an explicit rest_speed wins */
        assert_int_equal(percuss_slow_rests(drop->slow, BALL, GROUND, 0), given);
        drop_free(drop);
    }
}

/* Nothing holds the ball: it is hit again and again as it sinks, and never left to itself. */
static void overlapping_and_approaching_is_never_ignored(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        const struct manner manner = {.step = 1e-3, .restitution = 0.3, .symplectic = i};
        struct drop *drop = drop_create(&manner, 1e-3, 0.0);
        double slowest = 0.0;
        while (drop->time < 2.0) {
            go_on(drop);
            slowest = drop->gap <= 0.0 ? fmin(slowest, drop->speed) : slowest;
        }
        /* never faster after a call than two steps of free fall */
        assert_true(slowest >= -2.0 * gravity * manner.step);
        assert_true(drop->impacts > 100);
        drop_free(drop);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bouncing_ball_never_falls_through_the_ground),
        cmocka_unit_test(a_slow_approach_from_afar_is_an_impact),
        cmocka_unit_test(overlapping_and_approaching_is_never_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
