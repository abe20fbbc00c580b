/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Dormand and Prince's steps of the fifth order (J. Comput. Appl. Math. 6 (1980) 19) with the error
 * that those of the fourth tell: an own integration beside the solver's methods. */
#ifndef PERCUSS_TEST_RUNGE_KUTTA_H
#define PERCUSS_TEST_RUNGE_KUTTA_H

#include <assert.h>
#include <math.h>
#include <string.h>

enum { RUNGE_KUTTA_MOST = 64 };

struct runge_kutta {
    size_t size;
    void (*rates)(double time, const double *y, double *rate, void *context);
    /* after each step that is accepted; NULL: nothing */
    void (*accept)(double time, double *y, void *context);
    void *context;
    double tolerance, longest; /* of a step: absolute error, and length, > 0 */
};

/* Brings y from one instant to another. */
static inline void runge_kutta_run(const struct runge_kutta *of, double time, double end, double *y)
{
    enum { STAGES = 7 };
    static const double part[STAGES] = {0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0};
    static const double by[STAGES][STAGES] = {
        {0.0},
        {0.2},
        {3.0 / 40.0, 9.0 / 40.0},
        {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
        {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
        {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
        {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}};
    static const double off[STAGES] = {
        71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
        -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};
    double rate[STAGES][RUNGE_KUTTA_MOST], at[RUNGE_KUTTA_MOST], h = 1e-6 * (end - time);
    assert(of->size <= RUNGE_KUTTA_MOST);
    while (time < end) {
        double error = 0.0;
        h = fmin(fmin(h, of->longest), end - time);
        for (int s = 0; s < STAGES; s++) {
            memcpy(at, y, of->size * sizeof *y);
            for (size_t i = 0; i < of->size; i++)
                for (int r = 0; r < s; r++)
                    at[i] += h * by[s][r] * rate[r][i];
            of->rates(time + h * part[s], at, rate[s], of->context);
        }
        for (size_t i = 0; i < of->size; i++) {
            double sum = 0.0;
            for (int s = 0; s < STAGES; s++)
                sum += h * off[s] * rate[s][i];
            error = fmax(error, fabs(sum));
        }
        if (error <= of->tolerance) {
            time = h < end - time ? time + h : end;
            memcpy(y, at, of->size * sizeof *y); /* the last stage is at the solution */
            if (of->accept)
                of->accept(time, y, of->context);
        }
        h *= fmin(4.0, fmax(0.2, 0.9 * pow(of->tolerance / fmax(error, 1e-300), 0.2)));
    }
}

#endif
