/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/core/impact/oscillator.c: exact propagation against mpmath, against composition
 * of steps and against a brute integration. */
#include <string.h>

#include "check.h"
#include "impact/oscillator.h"

/* omega, damping, h, c and the maps to q and v: Duhamel's integrals with Lagrange's polynomials
 * through the Gauss nodes, by confluent hypergeometric functions in mpmath at 40 digits. */
static const struct {
    double omega, damping, h, c;
    double to_q[NODES + 2], to_v[NODES + 2];
} digits[] = {
    {1,
     0,
     1e-6,
     1,
     {0.9999999999995, 9.9999999999983333e-7, 1.6185132086228695e-13, 2.1846553629536423e-13,
      1.0760704113589055e-13, 1.2076101706416612e-14},
     {-9.9999999999983333e-7, 0.9999999999995, 1.7392742256865162e-7, 3.2607257743119989e-7,
      3.2607257743125532e-7, 1.7392742256872651e-7}},
    {1000,
     0.01,
     1e-4,
     0.33,
     {0.99945566916877612, 3.2983125197560668e-5, 4.4636173971469193e-10, 1.1053954932015397e-10,
      -1.5767692973429757e-11, 3.1972351624673022e-12},
     {-32.983125197560668, 0.9987960066648249, 1.8797109551471837e-5, 1.6300365780681687e-5,
      -2.7878909590680293e-6, 6.7354082447517418e-7}},
    {1000,
     0,
     2.9e-3,
     1,
     {-0.97095816514959052, 0.00023924932921398233, 2.1611362347247087e-7, 8.8079893834812887e-7,
      7.734199449689089e-7, 1.0062565836008188e-7},
     {-239.24932921398233, -0.97095816514959052, -0.00045647621796632108, -0.00034189845523929302,
      0.00054269965193880097, 0.00049492435048079547}},
    {1000,
     0.3,
     3.1e-3,
     1,
     {-0.36511712682833957, 7.5829531001238747e-5, 8.9667879175098705e-8, 5.2293150248012036e-7,
      6.4374122740117921e-7, 1.087765177719413e-7},
     {-75.829531001238747, -0.41061484542908282, -0.00023679614564380894, -0.00037303137734944401,
      0.00022313954030486724, 0.00046251751368962446}},
    {1e6,
     0.02,
     3.1e-5,
     0.93056815579702628761,
     {-0.47961017741198505, -3.0194294408045452e-7, 6.5472596377835953e-13, -2.8216165759697661e-13,
      1.6933674417750541e-13, 9.3770912705309672e-13},
     {301942.94408045452, -0.46753245964876687, -6.1949277257301753e-7, 5.694720115499592e-7,
      -5.2668175709998507e-7, 2.7475957404258888e-7}},
    {1e6,
     0,
     1e-3,
     1,
     {0.56237907629070299, 8.2687954053200256e-7, -9.6545241205968867e-13, 8.4682931468940642e-13,
      -1.0327885192693076e-12, 1.5890325403488869e-12},
     {-826879.54053200256, 0.56237907629070299, 1.265096369392685e-6, -6.7307195814799599e-7,
      3.217042485389623e-7, -8.6849119251648785e-8}},
    {1e4,
     0.99,
     5e-4,
     0.66999052179242813,
     {0.14820133769924811, 1.1706707859728001e-5, 1.1932238273956156e-9, 5.3958903331484381e-9,
      2.171489577360168e-9, -2.4261711489670276e-10},
     {-1170.6707859728001, -0.083591477923366306, -1.0961876595962028e-5, -9.4456678617371148e-6,
      3.4424535750057015e-5, -2.3102834326298705e-6}},
    {1e3,
     0.9999,
     2e-3,
     1,
     {0.40596975813548671, 0.00027068861262135016, 1.0079318560150133e-7, 2.2851051306462106e-7,
      2.2285154444771203e-7, 4.1874998750678876e-8},
     {-270.68861262135016, -0.13535332938468934, -4.6731534959007836e-5, -5.7649197065055051e-5,
      0.00011414267930890733, 0.00026092666533650572}},
};

static void maps_match_mpmath(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
        double omega = digits[i].omega, h = digits[i].h;
        double to_q[NODES + 2], to_v[NODES + 2];
        oscillator_map(omega, digits[i].damping, h, digits[i].c, to_q, to_v);
        /* phases of up to 1e3 rad carry a rounding of 1e-16 each, Lagrange's monomials of up to 31
         * cancel; close to critical damping two nearly equal exponentials are subtracted */
        double part = 4e-15 * (1.0 + omega * h) / sqrt(1.0 - digits[i].damping);
        double time = fmin(h, 1.0 / omega);
        for (int k = 0; k < NODES + 2; k++) {
            /* what a unit input moves q by, at most: 1, time, time^2 */
            double reach = k == 0 ? 1.0 : k == 1 ? time : time * time;
            measured("to q", to_q[k], digits[i].to_q[k], part * reach);
            measured("to v", to_v[k], digits[i].to_v[k], part * reach / time);
        }
    }
}

static const double frequencies[] = {1.0, 30.0, 1e3, 1e5, 1e7};
static const double dampings[] = {0.0, 1e-6, 0.01, 0.3, 0.9, 0.999};

/* Two steps of h/2 are one of h, and back again. */
static void steps_compose(void **state)
{
    (void)state;
    for (size_t i = 0; i < 30; i++) {
        double omega = frequencies[i % 5], damping = dampings[i / 5];
        for (double h = 1e-7; h < 1e-2; h *= 7.0) {
            double q[2] = {0.3, 0.3}, v[2] = {-0.2 * omega, -0.2 * omega};
            double scale =
                hypot(q[0], v[0] / omega) * 1e-15 * (4.0 + omega * h) / sqrt(1.0 - damping);
            oscillator_advance(omega, damping, h, &q[0], &v[0]);
            oscillator_advance(omega, damping, 0.5 * h, &q[1], &v[1]);
            oscillator_advance(omega, damping, 0.5 * h, &q[1], &v[1]);
            measured("q", q[1], q[0], scale);
            measured("v", v[1], v[0], scale * omega);
            if (damping * omega * h > 1.0)
                continue; /* the way back blows rounding up */
            oscillator_advance(omega, damping, -h, &q[0], &v[0]);
            measured("q back", q[0], 0.3, 4.0 * scale * exp(damping * omega * h));
            measured("v back", v[0], -0.2 * omega, 4.0 * scale * omega * exp(damping * omega * h));
        }
    }
}

/* A cubic force through four nodal values, integrated by Runge and Kutta in 4000 steps. */
static void forced_motion_matches_runge_kutta(void **state)
{
    (void)state;
    const double force[NODES] = {0.7, -0.2, 1.3, 0.4};
    for (size_t i = 0; i < sizeof dampings / sizeof *dampings; i++) {
        double omega = 40.0, damping = dampings[i], h = 0.2;
        double q = 0.01, v = -0.3;
        double to_q[NODES + 2], to_v[NODES + 2];
        double x[NODES + 2] = {q, v, force[0], force[1], force[2], force[3]};
        oscillator_map(omega, damping, h, 1.0, to_q, to_v);
        enum { STEPS = 4000 };
        double dt = h / STEPS;
        for (int n = 0; n < STEPS; n++) {
            double kq[4], kv[4], at_q = q, at_v = v;
            for (int s = 0; s < 4; s++) {
                double part = s == 0 ? 0.0 : s == 3 ? 1.0 : 0.5;
                if (s > 0) {
                    at_q = q + part * dt * kq[s - 1];
                    at_v = v + part * dt * kv[s - 1];
                }
                kq[s] = at_v;
                kv[s] = collocation_value(force, (n + part) / STEPS) -
                        omega * (2.0 * damping * at_v + omega * at_q);
            }
            q += dt / 6.0 * (kq[0] + 2.0 * kq[1] + 2.0 * kq[2] + kq[3]);
            v += dt / 6.0 * (kv[0] + 2.0 * kv[1] + 2.0 * kv[2] + kv[3]);
        }
        double q_end = 0.0, v_end = 0.0;
        for (int k = 0; k < NODES + 2; k++) {
            q_end += to_q[k] * x[k];
            v_end += to_v[k] * x[k];
        }
        /* (omega dt)^4 = 1.6e-11 per radian of 8 */
        measured("q", q_end, q, 1e-12);
        measured("v", v_end, v, 4e-11);
    }
}

/* The damper's work is what the oscillator lacks afterwards. */
static void free_loss_is_the_missing_energy(void **state)
{
    (void)state;
    for (size_t i = 0; i < 30; i++) {
        double omega = frequencies[i % 5], damping = dampings[i / 5];
        for (double angle = 1e-5; angle < 1e4; angle *= 9.0) {
            double q = 1.0 / omega, v = -0.6; /* energy 0.5 + 0.18 */
            double loss = oscillator_free_loss(omega, damping, angle / omega, q, v);
            oscillator_advance(omega, damping, angle / omega, &q, &v);
            double left = 0.5 * (v * v + omega * omega * q * q);
            /* rounding of the phase, and of energies of one */
            measured("loss", loss, 0.68 - left, 1e-15 * (10.0 + angle) / sqrt(1.0 - damping));
            assert_true(damping > 0.0 ? loss > 0.0 : loss == 0.0);
        }
    }
}

/* int_0^c e^(z(c-s)) s^m ds by recursion upward where it is stable, across the change of method. */
static void moments_are_continuous(void **state)
{
    (void)state;
    for (double angle = 0.0; angle < 6.2; angle += 0.3) {
        double complex direction = cexp(CMPLX(0.0, angle));
        double complex below[NODES], above[NODES];
        oscillator_moments(2.9999999999 * direction, 1.0, below);
        oscillator_moments(3.0000000001 * direction, 1.0, above);
        for (int m = 0; m < NODES; m++)
            /* the step of 2e-10 times a derivative of at most the moment itself, and e^3 roundings
             */
            measured("moment", cabs(above[m] - below[m]), 0.0, 4e-10 * cabs(below[m]) + 1e-13);
    }
    double complex zero[NODES];
    oscillator_moments(0.0, 0.5, zero);
    for (int m = 0; m < NODES; m++)
        measured("moment of zero", creal(zero[m]), pow(0.5, m + 1) / (m + 1), 1e-17);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_match_mpmath),
        cmocka_unit_test(steps_compose),
        cmocka_unit_test(forced_motion_matches_runge_kutta),
        cmocka_unit_test(free_loss_is_the_missing_energy),
        cmocka_unit_test(moments_are_continuous),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
