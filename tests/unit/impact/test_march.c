/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/march.c: the order of flights and contact phases, why a march ends,
 * its books, and what stops it; with methods of contacts that turn every gap rate round at once. */
#include "impact/march.h"
#include "unit/impact/toy_scene.h"

enum { MOST_PHASES = 8 };

/* Contacts without duration that give back half of the approach rate. */
struct bouncer {
    struct march march;
    size_t phases, touched[MOST_PHASES];
    double at[MOST_PHASES];       /* s */
    enum percuss_end_reason ends; /* the first phase so; NONE: the bodies part */
    enum percuss_status fails;    /* ... or so */
    bool ended;
};

static enum percuss_end_reason bounce(void *method, size_t contact)
{
    struct bouncer *bouncer = method;
    struct march *march = &bouncer->march;
    struct motion *motion = &march->outcome->motion;
    double before = motion->gap_rate[contact];
    assert_true(bouncer->phases < MOST_PHASES);
    assert_false(march_in_contact(march));
    bouncer->touched[bouncer->phases] = contact;
    bouncer->at[bouncer->phases++] = motion->time;
    march_open(march, contact, motion->time, before);
    assert_true(march_in_contact(march));
    if (bouncer->fails)
        return march_fail(march, bouncer->fails);
    motion->gap_rate[contact] = -0.5 * before;
    march->outcome->tracks[contact].open.impulse = -1.5 * before;
    if (bouncer->ends == PERCUSS_END_NONE)
        march_close(march, contact, motion->time, motion->gap_rate[contact]);
    return bouncer->ends;
}

static void note_end(void *method)
{
    struct bouncer *bouncer = method;
    bouncer->ended = true;
}

/* Two contacts, apart at first, the second one reached first: at 0.2 s, the first at 0.5 s. */
static void make(struct toy *toy)
{
    toy_init(toy, 2);
    toy->gap[0] = 0.5;
    toy->gap_rate[0] = -1.0;
    toy->gap[1] = 0.4;
    toy->gap_rate[1] = -2.0;
}

static enum percuss_status run(struct toy *toy, struct bouncer *bouncer, bool flies,
                               struct impact_outcome *outcome)
{
    const struct march_method method = {flies, bounce, note_end};
    assert_true(impact_create(outcome, &toy->scene, &toy->arena));
    bouncer->march.stated = &toy->scene;
    bouncer->march.outcome = outcome;
    if (bouncer->march.horizon == 0.0)
        bouncer->march.horizon = 10.0;
    if (bouncer->march.most == 0)
        bouncer->march.most = 1000;
    assert_true(march_create(&bouncer->march, &toy->arena));
    return march_run(&bouncer->march, &method, bouncer, &toy->arena);
}

static void flights_and_phases_take_turns(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    struct bouncer bouncer = {0};
    make(&toy);
    assert_int_equal(run(&toy, &bouncer, false, &outcome), PERCUSS_OK);
    assert_int_equal(bouncer.phases, 2);
    assert_int_equal(bouncer.touched[0], 1);
    assert_int_equal(bouncer.touched[1], 0);
    measured("first touch", bouncer.at[0], 0.2, 1e-15);
    measured("second touch", bouncer.at[1], 0.5, 1e-15);
    assert_true(bouncer.ended);
    assert_int_equal(outcome.end_reason, PERCUSS_END_SEPARATED);
    measured("shift", outcome.time_shift, 0.2, 1e-15);
    measured("impulse", outcome.tracks[1].impulse, 3.0, 0.0);
    measured("rate before", outcome.tracks[0].list[0].gap_rate_before, -1.0, 0.0);
    measured("rate after", outcome.tracks[0].list[0].gap_rate_after, 0.5, 0.0);
    /* half the rate: a quarter of the energy; the rest is nobody's */
    measured("rigid after", outcome.energy.rigid_after, 0.25 * outcome.energy.available, 1e-15);
    measured("closure", outcome.energy.closure, 0.75 * outcome.energy.available, 1e-15);
    toy_free(&toy);
}

/* A phase's end is the march's, with the books of what is closed then. */
static void a_phase_ends_the_march(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    struct bouncer bouncer = {.ends = PERCUSS_END_IN_CONTACT};
    make(&toy);
    assert_int_equal(run(&toy, &bouncer, false, &outcome), PERCUSS_OK);
    assert_int_equal(bouncer.phases, 1);
    assert_int_equal(outcome.end_reason, PERCUSS_END_IN_CONTACT);
    assert_int_equal(outcome.tracks[1].count, 1);
    measured("end", outcome.tracks[1].list[0].end, 0.2, 1e-15);
    measured("window", outcome.window, 0.2, 1e-15);
    toy_free(&toy);
    /* a method that flies itself begins where the march does */
    bouncer = (struct bouncer){.ends = PERCUSS_END_HORIZON};
    make(&toy);
    assert_int_equal(run(&toy, &bouncer, true, &outcome), PERCUSS_OK);
    assert_int_equal(bouncer.phases, 1);
    measured("began", bouncer.at[0], 0.0, 0.0);
    assert_int_equal(outcome.end_reason, PERCUSS_END_HORIZON);
    toy_free(&toy);
}

static void flights_end_the_march(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    struct bouncer late = {.march = {.horizon = 0.3}};
    make(&toy);
    assert_int_equal(run(&toy, &late, false, &outcome), PERCUSS_OK);
    assert_int_equal(late.phases, 1);
    assert_int_equal(outcome.end_reason, PERCUSS_END_HORIZON);
    measured("window", outcome.window, 0.3, 1e-15);
    toy_free(&toy);

    /* accelerated together: the slow scale sees them touch again */
    struct bouncer pressed = {0};
    make(&toy);
    toy.gap[0] = 0.0;
    toy.gap_acceleration[0] = -1e-3;
    toy.gap_rate[1] = 1.0;
    assert_int_equal(run(&toy, &pressed, false, &outcome), PERCUSS_OK);
    assert_int_equal(pressed.phases, 1);
    assert_int_equal(outcome.end_reason, PERCUSS_END_HANDED_BACK);
    toy_free(&toy);

    struct bouncer poor = {.march = {.most = 1}};
    make(&toy);
    assert_int_equal(run(&toy, &poor, false, &outcome), PERCUSS_OK);
    assert_int_equal(outcome.end_reason, PERCUSS_END_LIMIT);
    toy_free(&toy);
}

static bool never(void *context, double done)
{
    (void)context;
    (void)done;
    return false;
}

static void failures_are_told(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    struct bouncer failing = {.fails = PERCUSS_INTERNAL};
    make(&toy);
    assert_int_equal(run(&toy, &failing, false, &outcome), PERCUSS_INTERNAL);
    assert_false(failing.ended);
    toy_free(&toy);

    /* nobody waits */
    struct watch nobody = {never, NULL};
    struct pace pace = {.watch = &nobody};
    assert_false(pace_ask(&pace, 0.0));
    struct bouncer stopped = {.march = {.pace = &pace}};
    make(&toy);
    assert_int_equal(run(&toy, &stopped, false, &outcome), PERCUSS_TIMEOUT);
    assert_int_equal(stopped.phases, 0);
    toy_free(&toy);
}

/* Overlaps: back to the touch, or nothing is solved. */
static void overlaps_begin_at_their_touch(void **state)
{
    (void)state;
    struct toy toy;
    struct impact_outcome outcome;
    struct bouncer bouncer = {0};
    make(&toy);
    toy.gap[1] = -0.1; /* 0.05 s ago */
    assert_int_equal(run(&toy, &bouncer, false, &outcome), PERCUSS_OK);
    measured("shift", outcome.time_shift, -0.05, 1e-16);
    measured("touch", bouncer.at[0], -0.05, 1e-16);
    toy_free(&toy);

    bouncer = (struct bouncer){0};
    make(&toy);
    toy.gap[1] = -0.1;
    toy.gap_rate[1] = 1.0;
    assert_int_equal(run(&toy, &bouncer, false, &outcome), PERCUSS_OK);
    assert_true(outcome.always_overlapped);
    assert_false(bouncer.ended);
    toy_free(&toy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flights_and_phases_take_turns), cmocka_unit_test(a_phase_ends_the_march),
        cmocka_unit_test(flights_end_the_march),         cmocka_unit_test(failures_are_told),
        cmocka_unit_test(overlaps_begin_at_their_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
