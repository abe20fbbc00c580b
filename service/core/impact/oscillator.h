/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One damped oscillator q'' + 2 zeta omega q' + omega^2 q = f: exact solutions. */
#ifndef PERCUSS_IMPACT_OSCILLATOR_H
#define PERCUSS_IMPACT_OSCILLATOR_H

#include <complex.h>
#include <stdbool.h>
#include <stddef.h>

#include "impact/collocation.h"

/* glibc 2.36 has it for gcc only */
#ifndef CMPLX
#define CMPLX(x, y) __builtin_complex((double)(x), (double)(y))
#endif

/* Characteristic value lambda = -zeta omega + i omega sqrt(1 - zeta^2). */
double complex oscillator_lambda(double omega, double damping);

/* Free motion over any time (also backward), in place. */
void oscillator_advance(double omega, double damping, double time, double *q, double *v);

/* Energy that the damper takes during free motion over `time` from (q, v), J. */
double oscillator_free_loss(double omega, double damping, double time, double q, double v);

/* moments[m] = int_0^c exp(z (c - s)) s^m ds for m < NODES. */
void oscillator_moments(double complex z, double c, double complex moments[NODES]);

/* Linear map of (q, v, f_1..f_4) to q and v at the time c h into a step of length h: columns in
 * that order. */
void oscillator_map(double omega, double damping, double h, double c, double to_q[NODES + 2],
                    double to_v[NODES + 2]);

/* The same at `count` <= NODES places at once. */
void oscillator_maps(double omega, double damping, double h, size_t count, const double *c,
                     double (*to_q)[NODES + 2], double (*to_v)[NODES + 2]);

enum { LOSS_INPUTS = NODES + 2 };

/* 2 zeta omega int_0^h v^2 dt as a symmetric quadratic form of (q, v, f_1..f_4). */
void oscillator_loss_form(double omega, double damping, double h,
                          double form[LOSS_INPUTS][LOSS_INPUTS]);

enum { SERIES_ROWS = STEP_POINTS + 1 };

/* Whether an angle omega h is small enough for oscillator_series_response. */
bool oscillator_series_reaches(double angle);

/* by[point][j]: q at a node or the end by the force at node j; by[STEP_POINTS][j]: v at the end. */
void oscillator_series_response(double angle, double h, double by[SERIES_ROWS][NODES]);

#endif
