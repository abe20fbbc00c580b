/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/flight_kernel.c: bounds against sums written out, series and turns
 * against the exact motion of one oscillator after the other. */
#include <string.h>

#include "check.h"
#include "impact/flight_kernel.h"
#include "impact/oscillator.h"
#include "impact/step_table.h"

enum { LONGEST = 40 };

struct vectors {
    _Alignas(32) double omega[LONGEST], damping[LONGEST], phi[LONGEST], q[LONGEST], v[LONGEST];
    _Alignas(32) double q_end[LONGEST], v_end[LONGEST];
    struct flight_modes modes;
    size_t count;
};

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-52 - 1.0;
}

/* Frequencies up to 1 rad/s, ratios within 5 % of one. */
static void make(struct vectors *x, size_t count, double damping)
{
    uint64_t seed = count;
    memset(x, 0, sizeof *x);
    x->count = count;
    for (size_t k = 0; k < count; k++) {
        x->omega[k] = (double)(k + 1) / (double)count;
        x->damping[k] = damping * (1.0 + 0.05 * uniform(&seed));
        x->phi[k] = uniform(&seed);
        x->q[k] = uniform(&seed);
        x->v[k] = uniform(&seed);
    }
    x->modes = (struct flight_modes){(count + LANES - 1) / LANES * LANES,
                                     damping > 0.0 ? x->damping : NULL,
                                     x->omega,
                                     x->phi,
                                     x->q,
                                     x->v};
}

/* sums of at most 40 terms of order one in another order */
#define agrees(value, expected) near(value, expected, 2e-14 * (1.0 + fabs(expected)))

static void bounds_are_sums_of_amplitudes(void **state)
{
    (void)state;
    for (size_t count = 1; count <= LONGEST; count += 3) {
        struct vectors x;
        double reach[LONGEST / LANES + 1], bend[LONGEST / LANES + 1];
        make(&x, count, 0.02);
        flight_kernel_bounds(&x.modes, reach, bend);
        for (size_t j = 0; j <= x.modes.length / LANES; j++) {
            double fast = 0.0, slow = 0.0;
            for (size_t k = 0; k < count; k++) {
                double a = fabs(x.phi[k]) * hypot(x.q[k], x.v[k] / x.omega[k]);
                fast += k >= j * LANES ? a : 0.0;
                slow += k < j * LANES ? a * pow(x.omega[k], SCAN_TERMS) : 0.0;
            }
            agrees(reach[j], fast);
            agrees(bend[j], slow);
        }
    }
}

static const double DAMPINGS[] = {0.0, 0.05, 0.9};
enum { DAMPED = 3 };

/* sum phi q after a free motion over t */
static double moved(const struct vectors *x, double t)
{
    double sum = 0.0;
    for (size_t k = 0; k < x->count; k++) {
        double q = x->q[k], v = x->v[k];
        oscillator_advance(x->omega[k], x->damping[k], t, &q, &v);
        sum += x->phi[k] * q;
    }
    return sum;
}

/* The longer series is the motion as long as omega t does not exceed one; the shorter one but for
 * sum |phi| |A| (omega t)^8/8!, where |A| <= 1.5/sqrt(1 - zeta) sqrt(1 + 1/omega^2) here. */
static void derivatives_are_a_series_of_the_motion(void **state)
{
    (void)state;
    for (int i = 0; i < DAMPED; i++) {
        for (size_t count = 1; count <= LONGEST; count += 3) {
            struct vectors x;
            double longer[ROOT_TERMS] = {0.0}, shorter[SCAN_TERMS] = {0.0};
            double reach[LONGEST / LANES + 1], bend[LONGEST / LANES + 1];
            make(&x, count, DAMPINGS[i]);
            flight_kernel_derivatives(&x.modes, shorter);
            flight_kernel_bounds(&x.modes, reach, bend);
            for (double t = 0.1; t <= 1.0; t += 0.3) {
                double series = 0.0, scan = 0.0, power = 1.0, shares = 1.0;
                memset(longer, 0, sizeof longer);
                flight_kernel_terms(&x.modes, t, longer);
                for (int n = 0; n < ROOT_TERMS; n++) {
                    series += shares * longer[n];
                    scan += n < SCAN_TERMS ? power * shorter[n] : 0.0;
                    power *= t / (n + 1);
                    shares /= n + 1;
                }
                agrees(series, moved(&x, t));
                double rest = bend[x.modes.length / LANES] * pow(t, 8.0) / 40320.0;
                near(scan, moved(&x, t), rest / sqrt(1.0 - 1.05 * DAMPINGS[i]) + 1e-13);
            }
        }
    }
}

/* Against libm. An angle is a product of the frequency and the time, rounded; what has decayed to
 * 1e-304 is nothing. */
static void turns_are_exact(void **state)
{
    (void)state;
    for (int i = 0; i < DAMPED; i++) {
        struct vectors x;
        make(&x, 37, DAMPINGS[i]);
        for (double t = 1e-9; t <= FLIGHT_TURN_ANGLE; t *= 1.7) {
            flight_kernel_turn(&x.modes, t, x.q_end, x.v_end);
            for (size_t k = 0; k < x.count; k++) {
                double q = x.q[k], v = x.v[k];
                double size = hypot(q, v / x.omega[k]) / sqrt(1.0 - x.damping[k]);
                double left = exp(-x.damping[k] * x.omega[k] * t);
                double rounding = (2e-15 + 4e-16 * x.omega[k] * t) * left * size + 1e-300;
                oscillator_advance(x.omega[k], x.damping[k], t, &q, &v);
                near(x.q_end[k], q, rounding);
                near(x.v_end[k], v, rounding * x.omega[k]);
            }
            for (size_t k = x.count; k < x.modes.length; k++)
                assert_true(x.q_end[k] == 0.0 && x.v_end[k] == 0.0);
            /* the table gives the same bits */
            _Alignas(32) double table[TURN_TERMS * LONGEST], q_step[LONGEST], v_step[LONGEST];
            flight_kernel_table(&x.modes, t, table);
            flight_kernel_step(table, &x.modes, q_step, v_step);
            assert_memory_equal(q_step, x.q_end, x.modes.length * sizeof *q_step);
            assert_memory_equal(v_step, x.v_end, x.modes.length * sizeof *v_step);
        }
    }
}

/* Against the complex formula of one oscillator, to a rounding of the energy. In a short time that
 * cancels, and the loss is 2 zeta omega v^2 t but for the second order. */
static void losses_are_exact(void **state)
{
    (void)state;
    for (int i = 1; i < DAMPED; i++) {
        struct vectors x;
        make(&x, 37, DAMPINGS[i]);
        for (double t = 1e-9; t <= FLIGHT_TURN_ANGLE; t *= 1.7) {
            double loss = 0.0, energy = 0.0, power = 0.0;
            for (size_t k = 0; k < x.count; k++) {
                double w = x.omega[k];
                loss += oscillator_free_loss(w, x.damping[k], t, x.q[k], x.v[k]);
                energy += 0.5 * (x.v[k] * x.v[k] + w * w * x.q[k] * x.q[k]);
                power += 2.0 * x.damping[k] * w * x.v[k] * x.v[k];
            }
            near(flight_kernel_loss(&x.modes, t), loss, 1e-14 * energy);
            if (t < 1e-6)
                near(flight_kernel_loss(&x.modes, t), power * t, (1e-13 + 10.0 * t) * power * t);
        }
    }
}

/* Not moved at all, and moved until nothing is left. */
static void no_time_and_all_time(void **state)
{
    (void)state;
    struct vectors x;
    make(&x, 7, 0.9);
    flight_kernel_turn(&x.modes, 0.0, x.q_end, x.v_end);
    assert_memory_equal(x.q_end, x.q, sizeof x.q);
    assert_memory_equal(x.v_end, x.v, sizeof x.v);
    flight_kernel_turn(&x.modes, FLIGHT_TURN_ANGLE, x.q_end, x.v_end);
    for (size_t k = 0; k < x.modes.length; k++)
        assert_true(x.q_end[k] == 0.0 && x.v_end[k] == 0.0);
    /* in place */
    flight_kernel_turn(&x.modes, 0.3, x.q_end, x.v_end);
    flight_kernel_turn(&x.modes, 0.3, x.q, x.v);
    assert_memory_equal(x.q_end, x.q, sizeof x.q);
    assert_memory_equal(x.v_end, x.v, sizeof x.v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_are_sums_of_amplitudes),
        cmocka_unit_test(derivatives_are_a_series_of_the_motion),
        cmocka_unit_test(turns_are_exact),
        cmocka_unit_test(losses_are_exact),
        cmocka_unit_test(no_time_and_all_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
