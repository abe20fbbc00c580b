/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The four solutions w(s) e^(i omega t) of a uniform Timoshenko beam, s = x/length in
 * [-1/2, 1/2], and their end values. Private to the files beam_*.c.
 *
 * With b^2 = rhoA L^4 omega^2/EI, r^2 = rhoI/(rhoA L^2), q^2 = EI/(kGA L^2), slope Psi = L psi,
 * moment M = Psi', shear V = (w' - Psi)/q^2, the equations are V' = -b^2 w and
 * Psi'' + V + b^2 r^2 Psi = 0 (Timoshenko 1921). e^(lambda s) solves them for
 *   lambda^4 + b^2 (r^2 + q^2) lambda^2 - b^2 (1 - b^2 r^2 q^2) = 0,
 * with Psi = (lambda^2 + b^2 q^2)/lambda w and V = -b^2/lambda w: lambda = +-alpha, +-i beta. Above
 * the cut-off b r q = 1 alpha is imaginary. r = q = 0 is Euler-Bernoulli's beam. */
#ifndef PERCUSS_MODEL_BEAM_WAVE_H
#define PERCUSS_MODEL_BEAM_WAVE_H

#include <stdbool.h>

#include "model/body.h"

struct beam_ratios {
    double inertia; /* r^2 */
    double shear;   /* q^2 */
};

/* C(s) and P(s) are cosh(alpha s) and sinh(alpha s)/alpha over cosh(alpha/2); above the cut-off
 * cos(a s) and sin(a s)/a with a = |alpha|. They are regular where alpha vanishes and never
 * overflow. */
struct beam_wave {
    double b;
    double alpha, beta;   /* moduli */
    double alpha_squared; /* signed: negative above the cut-off */
    double hyper, trig;   /* alpha^2 + b^2 q^2 and beta^2 - b^2 q^2: Psi/w times lambda; > 0 */
    double cosh_end;      /* C(1/2) */
    double sinh_end;      /* P(1/2) */
    double cos_end;       /* cos(beta/2) */
    double sin_end;       /* sin(beta/2) */
    double sech_squared;  /* 1/cosh(alpha/2)^2; 1 above the cut-off */
};

/* Even deflections are a combination of C(s) and cos(beta s), odd ones of alpha^2 P(s)/beta and
 * sin(beta s); COUPLED ones of all four, which unequal supports need. */
enum beam_parity { BEAM_EVEN, BEAM_ODD, BEAM_COUPLED };

struct beam_wave beam_wave_at(const struct beam_ratios *ratios, double b);

/* Deflection, Psi, M, V/b^2 */
enum beam_quantity { BEAM_DEFLECTION, BEAM_SLOPE, BEAM_MOMENT, BEAM_SHEAR };

/* A quantity of the two solutions of the even or the odd class at s = 1/2. */
void beam_wave_end_values(const struct beam_wave *wave, enum beam_quantity quantity,
                          enum beam_parity parity, double values[2]);

/* What a support holds at zero, as two conditions on the two solutions of the even or odd class,
 * scaled so that their rounding errors are alike. */
void beam_wave_conditions(const struct beam_wave *wave, enum support support,
                          enum beam_parity parity, double rows[2][2]);

/* The conditions of both ends on all four solutions (even, even, odd, odd). */
void beam_wave_coupled_conditions(const struct beam_wave *wave, const enum support supports[2],
                                  double rows[4][4]);

#endif
