/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/impact/flight.c: the first touch of vibrating bodies, hidden double roots, and
 * the end, against a search that samples without mercy. */
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
        cmocka_unit_test(completes_when_the_bound_is_passed),
        cmocka_unit_test(the_first_of_two_contacts),
        cmocka_unit_test(effort_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
