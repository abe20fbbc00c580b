/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/flight_root.c: parabolas by their closed roots, touches of one
 * oscillator by arc cosine, grazes and misses of a picometre, several roots close together. */
#include "impact/flight_root.h"
#include "unit/impact/toy_scene.h"

static void parabolas_exceed(void **state)
{
    (void)state;
    static const struct {
        double excess, rate, acceleration, first, last;
    } cases[] = {
        {1.0, 0.0, 0.0, 0.0, INFINITY},
        {1.0, 2.0, 0.0, 0.0, INFINITY},
        {-1.0, 2.0, 0.0, 0.5, INFINITY},
        {1.0, -2.0, 0.0, INFINITY, INFINITY},
        {-1.0, 0.0, 0.0, INFINITY, INFINITY},
        {1.0, 2.0, 3.0, 0.0, INFINITY},
        {-1.0, 0.0, 2.0, 1.0, INFINITY},              /* t^2 = 1 */
        {1.0, -1.0, 2.0, 0.0, INFINITY},              /* turns before it falls below */
        {2.0, -3.0, 2.0, 2.0, INFINITY},              /* (t - 1)(t - 2) */
        {-1.0, 1.0, -0.1, 1.05572809000084122, 10.0}, /* until the top of the way */
        {1.0, 1.0, -2.0, 0.0, 0.5},
        {-1.0, 1.0, -2.0, INFINITY, INFINITY},
        {1.0, -1.0, -2.0, INFINITY, INFINITY},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double first, last;
        flight_root_exceeds(cases[i].excess, cases[i].rate, cases[i].acceleration, &first, &last);
        near(first, cases[i].first, 1e-15);
        if (isfinite(cases[i].first))
            near(last, cases[i].last, 1e-15);
    }
}

/* Closing rates that may be none are, where they leave the gap open for the time left. */
static void rates_within_what_is_unknown(void **state)
{
    (void)state;
    assert_true(flight_root_rate(1e-4, -1e-9, 2e-9, 1.0) == 0.0);
    assert_true(flight_root_rate(1e-4, -1e-9, 5e-10, 1.0) == -1e-9);
    assert_true(flight_root_rate(1e-10, -1e-9, 2e-9, 1.0) == -1e-9);
    assert_true(flight_root_rate(-1e-4, -1e-9, 2e-9, 1.0) == -1e-9);
    assert_true(flight_root_rate(1e-4, 1e-9, 2e-9, 1.0) == 1e-9);
    assert_true(flight_root_rate(0.0, -1e-9, 2e-9, 0.0) == -1e-9);
}

/* Approach -gap - rate t + cos(omega t) by one mode of unit amplitude that starts at its far end.
 */
static void ring(struct toy *toy, double omega, double gap, double rate)
{
    const double shape = -1.0, q = 1.0, v = 0.0;
    toy_init(toy, 1);
    toy->gap[0] = gap;
    toy->gap_rate[0] = rate;
    toy_ring(toy, toy_add(toy, 0, 1, &omega, 0.0, &shape), &q, &v);
}

static void start(struct toy *toy, struct motion *motion)
{
    assert_true(motion_create(motion, &toy->scene, &toy->arena));
    motion_start(motion, &toy->scene);
}

/* As flight_root_touch, on [from, to]. */
static bool touch(struct toy *toy, const struct motion *start, double from, double to, double *time)
{
    struct motion motion;
    assert_true(motion_create(&motion, &toy->scene, &toy->arena));
    motion_copy(&motion, start, &toy->scene);
    motion_advance(&motion, &toy->scene, from);
    bool found = flight_root_touch(&motion, &toy->scene, 0, to - from, time);
    *time += from;
    return found;
}

static void touches_by_arc_cosine(void **state)
{
    (void)state;
    for (double gap = -0.9; gap < 0.95; gap += 0.1) {
        struct toy toy;
        struct motion motion;
        double time = -1.0;
        ring(&toy, 2.0, gap, 0.0);
        start(&toy, &motion);
        /* cos(2t) rises through gap at 2t = 2 pi - acos(gap) */
        double expected = M_PI - 0.5 * acos(gap);
        assert_true(touch(&toy, &motion, expected - 0.1, expected + 0.05, &time));
        /* a rounding of the cosine and one of the motion before, over the slope */
        near(time, expected, 4e-16 * expected / fmax(0.1, sqrt(1.0 - gap * gap)));
        assert_false(touch(&toy, &motion, expected - 0.1, expected - 0.01, &time));
        toy_free(&toy);
    }
}

/* The peak of cos at 2t = 2 pi, with the gap a hair below and above it. */
static void tells_a_graze_from_a_miss(void **state)
{
    (void)state;
    for (double depth = 1e-3; depth > 5e-15; depth *= 0.1) {
        for (int misses = 0; misses < 2; misses++) {
            for (double left = 0.03; left < 0.2; left += 0.03) {
                struct toy toy;
                struct motion motion;
                double time = -1.0;
                ring(&toy, 2.0, misses ? 1.0 + depth : 1.0 - depth, 0.0);
                start(&toy, &motion);
                bool touches = touch(&toy, &motion, M_PI - left, M_PI + 0.21 - left, &time);
                assert_true(touches == !misses);
                /* the root lies asin(sqrt(depth/2)) before the peak; a rounding of the cosine moves
                 * it by 1e-16 over the slope there */
                if (touches)
                    near(time, M_PI - asin(sqrt(0.5 * depth)), 1e-15 + 2e-16 / sqrt(depth));
                toy_free(&toy);
            }
        }
    }
}

/* At the very start of a flight: approaching counts, leaving does not. */
static void a_touch_at_once(void **state)
{
    (void)state;
    for (int closing = 0; closing < 2; closing++) {
        struct toy toy;
        struct motion motion;
        double time = -1.0;
        toy_init(&toy, 1);
        toy.gap_rate[0] = closing ? -1.0 : 1.0;
        start(&toy, &motion);
        assert_true(flight_root_touch(&motion, &toy.scene, 0, 1.0, &time) == (closing == 1));
        if (closing)
            near(time, 0.0, 0.0);
        toy_free(&toy);
    }
}

/* Touching at rest: what presses closes at once, what draws apart or does nothing never. */
static void a_touch_at_rest(void **state)
{
    (void)state;
    for (int presses = -1; presses <= 1; presses++) {
        struct toy toy;
        struct motion motion;
        double time = -1.0;
        toy_init(&toy, 1);
        toy.gap_acceleration[0] = -9.81 * presses;
        start(&toy, &motion);
        assert_true(flight_root_touch(&motion, &toy.scene, 0, 1.0, &time) == (presses == 1));
        if (presses == 1)
            near(time, 0.0, 0.0);
        toy_free(&toy);
    }
}

/* Modes of which none turns by more than 1 rad together make an approach with three roots: the
 * derivatives 2, 4, 6 and 8 of four modes are set by their displacements, those 3, 5, 7 and 9 by
 * their velocities, gap and its rate do the rest. What remains from the tenth on is a bounded
 * amplitude's 1/10!. */
enum { WIGGLES = 4 };

/* weights x with sum_k x_k (-w_k^2)^n = (n == 1) for n = 1 ... 4: Lagrange's, over -w^2 */
static void weigh(const double *omega, double *x)
{
    for (int k = 0; k < WIGGLES; k++) {
        x[k] = -1.0 / (omega[k] * omega[k]);
        for (int j = 0; j < WIGGLES; j++)
            if (j != k)
                x[k] *= omega[j] * omega[j] / (omega[j] * omega[j] - omega[k] * omega[k]);
    }
}

/* The approach sign (t - r0)(t - r1)(t - r2), by its value and derivatives. */
static void make_cubic(struct toy *toy, const double r[3], double sign)
{
    static const double omega[WIGGLES] = {0.4, 0.6, 0.8, 1.0};
    static const double shape[WIGGLES] = {1.0, 1.0, 1.0, 1.0};
    double weight[WIGGLES], q[WIGGLES], v[WIGGLES];
    weigh(omega, weight);
    toy_init(toy, 1);
    toy->gap[0] = sign * r[0] * r[1] * r[2];
    toy->gap_rate[0] = -sign * (r[0] * r[1] + r[1] * r[2] + r[0] * r[2]);
    for (int k = 0; k < WIGGLES; k++) {
        q[k] = 2.0 * sign * (r[0] + r[1] + r[2]) * weight[k];
        v[k] = -6.0 * sign * weight[k];
        toy->gap[0] -= q[k];
        toy->gap_rate[0] -= v[k];
    }
    toy_ring(toy, toy_add(toy, 0, WIGGLES, omega, 0.0, shape), q, v);
}

static void the_first_of_three_roots(void **state)
{
    (void)state;
    static const double roots[][3] = {
        {0.2, 0.5, 0.9}, {0.5, 0.55, 0.6}, {0.1, 0.8, 0.801}, {0.3, 0.3001, 0.3002}};
    for (size_t i = 0; i < sizeof roots / sizeof *roots; i++) {
        for (int rising = 0; rising < 2; rising++) {
            struct toy toy;
            struct motion motion;
            double time = -1.0, d, rate;
            const double *r = roots[i];
            make_cubic(&toy, r, rising ? 1.0 : -1.0);
            start(&toy, &motion);
            assert_true(flight_root_touch(&motion, &toy.scene, 0, 1.0, &time));
            /* sums of some 1e2 */
            motion_approach_at(&motion, &toy.scene, 0, time, &d, &rate);
            assert_true(fabs(d) < 1e-13 && rate > 0.0);
            /* what is left of the tenth derivative over 10!, over the cubic's slope there */
            double root = rising ? r[0] : r[1];
            double slope = (root - (rising ? r[1] : r[0])) * (root - r[2]);
            near(time, root, 1e-8 / fabs(slope));
            /* none before it */
            for (int j = 0; rising && j < 1000; j++) {
                motion_approach_at(&motion, &toy.scene, 0, time * j / 1000.0, &d, &rate);
                assert_true(d < 0.0);
            }
            toy_free(&toy);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parabolas_exceed),         cmocka_unit_test(rates_within_what_is_unknown),
        cmocka_unit_test(touches_by_arc_cosine),    cmocka_unit_test(tells_a_graze_from_a_miss),
        cmocka_unit_test(a_touch_at_once),          cmocka_unit_test(a_touch_at_rest),
        cmocka_unit_test(the_first_of_three_roots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
