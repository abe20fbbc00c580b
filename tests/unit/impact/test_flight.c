/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/flight.c: the first touch of vibrating bodies, hidden double roots,
 * and the end, against a search that samples without mercy. */
#include "impact/flight.h"
#include "unit/impact/toy_scene.h"

enum { MODES = 4 };

static double uniform(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

/* Random modes at one contact, frequencies over two decades, amplitudes falling with them. */
static void make(struct toy *toy, uint64_t *seed, double damping)
{
    double omega[MODES], shape[MODES], q[MODES], v[MODES];
    toy_init(toy, 1);
    for (int k = 0; k < MODES; k++) {
        omega[k] = 100.0 * pow(5.0, k) * uniform(seed, 0.7, 1.4);
        shape[k] = uniform(seed, -1.0, 1.0);
        q[k] = uniform(seed, -1e-4, 1e-4) * 100.0 / omega[k];
        v[k] = uniform(seed, -1e-4, 1e-4) * 100.0;
    }
    toy_ring(toy, toy_add(toy, 0, MODES, omega, damping, shape), q, v);
}

static enum flight_end find(struct toy *toy, double allowed, double *time)
{
    struct motion motion;
    struct flight flight;
    size_t contact = 9;
    assert_true(motion_create(&motion, &toy->scene, &toy->arena));
    assert_true(flight_create(&flight, &toy->scene, &toy->arena));
    motion_start(&motion, &toy->scene);
    enum flight_end end =
        flight_find(&flight, &toy->scene, &motion, allowed, 10000000, time, &contact);
    assert_true(end != FLIGHT_TOUCH || contact < toy->scene.contacts);
    return end;
}

static double approach(struct toy *toy, const struct motion *motion, double t, double *rate)
{
    double d;
    motion_approach_at(motion, &toy->scene, 0, t, &d, rate);
    return d;
}

/* The highest peak of the approach in [0, span], by sampling and then halving the rate's sign. */
static double highest_peak(struct toy *toy, double span, double step, double *when)
{
    struct motion motion;
    double rate;
    double best = -INFINITY;
    *when = 0.0;
    assert_true(motion_create(&motion, &toy->scene, &toy->arena));
    motion_start(&motion, &toy->scene);
    for (double t = step; t < span; t += step) {
        double d = approach(toy, &motion, t, &rate);
        if (d > best) {
            best = d;
            *when = t;
        }
    }
    double low = *when - step, high = *when + step;
    for (int i = 0; i < 80; i++) {
        double middle = 0.5 * (low + high);
        approach(toy, &motion, middle, &rate);
        if (rate > 0.0)
            low = middle;
        else
            high = middle;
    }
    *when = 0.5 * (low + high);
    return approach(toy, &motion, *when, &rate);
}

/* The gap is set a hair below or above the highest peak of all: a double root that lasts for some
 * 1e-9 s of an interval of the slowest mode's 60 ms. */
static void hidden_double_roots_are_found(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int trial = 0; trial < 40; trial++) {
        struct toy toy;
        double when, time;
        make(&toy, &seed, 0.0);
        toy.gap_rate[0] = uniform(&seed, 1e-4, 2e-3); /* opens slowly, so that the peaks fall */
        double span = 0.05;
        double top = highest_peak(&toy, span, 2e-6, &when);
        if (top <= 0.0 || when < 1e-4 || when > 0.9 * span) {
            toy_free(&toy);
            continue;
        }
        static const double depths[] = {1e-12, 1e-14, -1e-12, -1e-14};
        for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
            toy.gap[0] = top - depths[i];
            enum flight_end end = find(&toy, span, &time);
            if (depths[i] > 0.0) {
                assert_int_equal(end, FLIGHT_TOUCH);
                /* within sqrt(2 depth/curvature) of the peak; curvatures are 1 m/s^2 and more */
                assert_true(time <= when && time > when - 5e-6);
            } else {
                assert_true(end != FLIGHT_TOUCH);
            }
        }
        toy_free(&toy);
    }
}

/* Whatever the scan says, samples must not contradict: none above zero before the touch, none at
 * all before the end. */
static void samples_never_contradict(void **state)
{
    (void)state;
    uint64_t seed = 2;
    int touches = 0, completions = 0, timeouts = 0;
    for (int trial = 0; trial < 200; trial++) {
        struct toy toy;
        struct motion motion;
        double time, rate;
        make(&toy, &seed, trial % 3 == 2 ? uniform(&seed, 0.001, 0.1) : 0.0);
        toy.gap[0] = uniform(&seed, 0.0, 4e-4);
        toy.gap_rate[0] = uniform(&seed, -4e-3, 1e-2);
        toy.gap_acceleration[0] = trial % 2 ? uniform(&seed, -0.3, 0.3) : 0.0;
        assert_true(motion_create(&motion, &toy.scene, &toy.arena));
        motion_start(&motion, &toy.scene);
        if (approach(&toy, &motion, 0.0, &rate) >= 0.0) {
            toy_free(&toy);
            continue;
        }
        enum flight_end end = find(&toy, 0.3, &time);
        assert_true(end != FLIGHT_LIMIT && time >= 0.0 && time <= 0.3);
        for (int i = 1; i < 20000; i++)
            assert_true(approach(&toy, &motion, time * i / 20000.0, &rate) < 1e-18);
        if (end == FLIGHT_TOUCH) {
            assert_true(fabs(approach(&toy, &motion, time, &rate)) < 1e-17);
            assert_true(rate >= 0.0);
        }
        /* for good: without acceleration nothing closes after completion either */
        for (int i = 0; end == FLIGHT_COMPLETE && toy.gap_acceleration[0] >= 0.0 && i < 20000; i++)
            assert_true(approach(&toy, &motion, time + i * 2e-5, &rate) <= 1e-18);
        touches += end == FLIGHT_TOUCH;
        completions += end == FLIGHT_COMPLETE;
        timeouts += end == FLIGHT_TIMEOUT;
        toy_free(&toy);
    }
    /* the trials must mean something */
    assert_true(touches > 20 && completions > 20 && timeouts > 0);
}

/* Two bodies with up to 40 modes each at up to three contacts, frequencies over three decades,
 * amplitudes that fall with a random power of them, some damped, all alike or each mode by itself,
 * some pressed together. */
enum { MANY = 40, SCENES = 400 };

static void make_many(struct toy *toy, uint64_t *seed)
{
    double omega[MANY], shape[MANY * TOY_CONTACTS], q[MANY], v[MANY];
    size_t contacts = 1 + (size_t)uniform(seed, 0.0, 2.999);
    bool pressed = uniform(seed, 0.0, 1.0) < 0.3;
    toy_init(toy, contacts);
    for (size_t g = 0; g < 1 + (size_t)uniform(seed, 0.0, 1.999); g++) {
        size_t count = 1 + (size_t)uniform(seed, 0.0, MANY - 0.001);
        double damping = uniform(seed, 0.0, 1.0) < 0.4 ? uniform(seed, 1e-4, 0.3) : 0.0;
        double falls = uniform(seed, 0.5, 2.5);
        for (size_t k = 0; k < count; k++) {
            double x = ((double)k + uniform(seed, 0.0, 0.9)) / (double)count;
            omega[k] = 300.0 * pow(1000.0, x);
            double size = 1e-4 * pow(300.0 / omega[k], falls);
            q[k] = uniform(seed, -size, size);
            v[k] = uniform(seed, -size, size) * omega[k];
        }
        for (size_t i = 0; i < count * contacts; i++)
            shape[i] = uniform(seed, -1.0, 1.0);
        struct scene_group *group = toy_add(toy, g, count, omega, damping, shape);
        if (damping > 0.1) {
            double each[MANY];
            for (size_t k = 0; k < count; k++)
                each[k] = k % 8 < 4 ? damping : 1e-3 * damping;
            oscillators_free(group->set);
            group->set = oscillators_create_each(count, omega, each);
            assert_non_null(group->set);
        }
        toy_ring(toy, group, q, v);
    }
    for (size_t c = 0; c < contacts; c++) {
        toy->gap[c] = uniform(seed, 0.0, 3e-4);
        toy->gap_rate[c] = uniform(seed, -3e-2, 5e-2);
        toy->gap_acceleration[c] = pressed ? uniform(seed, -30.0, 5.0) : 0.0;
    }
}

/* The highest approach of all contacts at an instant. */
static double highest(const struct toy *toy, const struct motion *motion)
{
    double top = -INFINITY;
    for (size_t c = 0; c < toy->scene.contacts; c++) {
        double d, rate;
        motion_approach(motion, &toy->scene, c, &d, &rate);
        top = fmax(top, d);
    }
    return top;
}

/* Goes from sample to sample by the tables, some 30 a period of the fastest mode, until `end`;
 * returns the highest approach seen. */
static double highest_until(const struct toy *toy, struct motion *motion, double end)
{
    double top = highest(toy, motion);
    int level = step_level(0.2 / scene_highest_frequency(&toy->scene));
    for (size_t g = 0; g < toy->scene.groups; g++)
        assert_non_null(oscillators_table(toy->groups[g].set, level));
    while (motion->time + step_length(level) < end) {
        motion_step(motion, motion, &toy->scene, level);
        top = fmax(top, highest(toy, motion));
    }
    return top;
}

/* What flight_find says of a scene against samples: none above zero before the touch or the end,
 * and the motion there is the exact one. */
static enum flight_end check_many(struct toy *toy, struct motion *motion)
{
    struct flight flight;
    struct motion end_motion;
    double time;
    size_t contact;
    assert_true(flight_create(&flight, &toy->scene, &toy->arena));
    assert_true(motion_create(&end_motion, &toy->scene, &toy->arena));
    motion_copy(&end_motion, motion, &toy->scene);
    enum flight_end end =
        flight_find(&flight, &toy->scene, motion, 0.01, 10000000, &time, &contact);
    assert_true(end != FLIGHT_LIMIT && end != FLIGHT_MEMORY && time >= 0.0 && time <= 0.01);
    /* rounding of motions of 1e-4 m after some 1e4 steps of samples */
    assert_true(highest_until(toy, motion, time) < 1e-16);
    motion_advance(&end_motion, &toy->scene, time);
    for (size_t c = 0; c < toy->scene.contacts; c++) {
        double d[2], rate[2];
        motion_approach(&end_motion, &toy->scene, c, &d[0], &rate[0]);
        motion_approach(&flight.probe, &toy->scene, c, &d[1], &rate[1]);
        /* of 1e-4 m and 1 m/s, and phases of 3e3 rad */
        near(d[1], d[0], 1e-16);
        near(rate[1], rate[0], 1e-12);
        if (end == FLIGHT_TOUCH && c == contact)
            assert_true(fabs(d[1]) < 1e-17 && rate[1] >= 0.0);
    }
    /* for good: three times as long */
    bool pressed = false;
    for (size_t c = 0; c < toy->scene.contacts; c++)
        pressed = pressed || toy->gap_acceleration[c] < 0.0;
    if (end == FLIGHT_COMPLETE && !pressed)
        assert_true(highest_until(toy, motion, 3.0 * time) < 1e-16);
    return end;
}

static void many_modes_at_several_contacts(void **state)
{
    (void)state;
    uint64_t seed = 3;
    int ends[FLIGHT_MEMORY + 1] = {0};
    for (int trial = 0; trial < SCENES; trial++) {
        struct toy toy;
        struct motion motion;
        make_many(&toy, &seed);
        assert_true(motion_create(&motion, &toy.scene, &toy.arena));
        motion_start(&motion, &toy.scene);
        if (highest(&toy, &motion) < 0.0)
            ends[check_many(&toy, &motion)]++;
        toy_free(&toy);
    }
    /* the trials must mean something */
    assert_true(ends[FLIGHT_TOUCH] > 50 && ends[FLIGHT_COMPLETE] > 20 && ends[FLIGHT_TIMEOUT] > 0);
}

/* Complete at the first instant at which gap and bound meet: sum of |shape| sqrt(q^2 +
 * v^2/omega^2). */
static void completes_when_the_bound_is_passed(void **state)
{
    (void)state;
    static const double omega = 300.0, shape = 0.5, q = 1e-4, v = 0.04;
    struct toy toy;
    double time;
    double bound = shape * hypot(q, v / omega);
    toy_init(&toy, 1);
    toy_ring(&toy, toy_add(&toy, 0, 1, &omega, 0.0, &shape), &q, &v);
    toy.gap[0] = 0.5 * bound;
    toy.gap_rate[0] = 0.2; /* faster than the vibration's 0.02: it never touches */
    assert_int_equal(find(&toy, 1.0, &time), FLIGHT_COMPLETE);
    assert_true(fabs(time - 0.5 * bound / 0.2) < 1e-15);
    /* too slow for the time allowed */
    assert_int_equal(find(&toy, 1e-4, &time), FLIGHT_TIMEOUT);
    assert_true(time == 1e-4);
    toy_free(&toy);
}

/* Two contacts: the earlier touch is reported; all of them must be passed to be complete. */
static void the_first_of_two_contacts(void **state)
{
    (void)state;
    struct toy toy;
    struct motion motion;
    struct flight flight;
    double time;
    size_t contact;
    toy_init(&toy, 2);
    toy.gap[0] = 3e-4;
    toy.gap_rate[0] = -0.1; /* touches after 3 ms */
    toy.gap[1] = 1e-4;
    toy.gap_rate[1] = -0.05; /* after 2 ms */
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    assert_true(flight_create(&flight, &toy.scene, &toy.arena));
    motion_start(&motion, &toy.scene);
    assert_int_equal(flight_find(&flight, &toy.scene, &motion, 1.0, 1000, &time, &contact),
                     FLIGHT_TOUCH);
    assert_int_equal(contact, 1);
    assert_true(fabs(time - 2e-3) < 1e-15);
    toy.gap_rate[1] = 0.05;
    motion_start(&motion, &toy.scene);
    assert_int_equal(flight_find(&flight, &toy.scene, &motion, 1.0, 1000, &time, &contact),
                     FLIGHT_TOUCH);
    assert_int_equal(contact, 0);
    assert_true(fabs(time - 3e-3) < 1e-15);
    toy_free(&toy);
}

/* A contact that is pressed where it rests closes at once: it does not wait, overlapping, for
 * another one's touch. */
static void a_pressed_contact_at_rest(void **state)
{
    (void)state;
    struct toy toy;
    struct motion motion;
    struct flight flight;
    double time;
    size_t contact;
    toy_init(&toy, 2);
    toy.gap[0] = 2e-4;
    toy.gap_rate[0] = -1.0;
    toy.gap_acceleration[1] = -5e4;
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    assert_true(flight_create(&flight, &toy.scene, &toy.arena));
    motion_start(&motion, &toy.scene);
    assert_int_equal(flight_find(&flight, &toy.scene, &motion, 1.0, 1000, &time, &contact),
                     FLIGHT_TOUCH);
    assert_int_equal(contact, 1);
    assert_true(time == 0.0);
    toy_free(&toy);
}

/* The effort is bounded: a fast mode far away costs nothing, a hopeless scan stops. */
static void effort_is_bounded(void **state)
{
    (void)state;
    static const double omega = 1e7, shape = 1.0, q = 1e-9, v = 0.0;
    struct toy toy;
    struct motion motion;
    struct flight flight;
    double time;
    size_t contact;
    toy_init(&toy, 1);
    toy_ring(&toy, toy_add(&toy, 0, 1, &omega, 0.0, &shape), &q, &v);
    toy.gap[0] = 1e-3;
    toy.gap_rate[0] = -0.01; /* 0.1 s of flight are 1e6 rad */
    assert_true(motion_create(&motion, &toy.scene, &toy.arena));
    assert_true(flight_create(&flight, &toy.scene, &toy.arena));
    motion_start(&motion, &toy.scene);
    assert_int_equal(flight_find(&flight, &toy.scene, &motion, 1.0, 100000, &time, &contact),
                     FLIGHT_TOUCH);
    assert_true(flight.intervals < 2000);
    assert_int_equal(flight_find(&flight, &toy.scene, &motion, 1.0, 5, &time, &contact),
                     FLIGHT_LIMIT);
    toy_free(&toy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hidden_double_roots_are_found),
        cmocka_unit_test(samples_never_contradict),
        cmocka_unit_test(many_modes_at_several_contacts),
        cmocka_unit_test(completes_when_the_bound_is_passed),
        cmocka_unit_test(the_first_of_two_contacts),
        cmocka_unit_test(a_pressed_contact_at_rest),
        cmocka_unit_test(effort_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
