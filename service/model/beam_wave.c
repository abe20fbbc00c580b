/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/beam_wave.h"

#include <math.h>

/* b r q beyond which the first wave is trigonometric is where alpha^2 changes sign; alpha itself
 * stays above this, so that quotients by it are finite and have their limits. */
static const double SMALLEST_ALPHA = 1e-150;

/* alpha^2 and beta^2 without cancellation: with p = b^2(r^2 + q^2) and c = b^2(1 - b^2 r^2 q^2),
 * beta^2 = p/2 + sqrt(p^2/4 + c) and alpha^2 beta^2 = c. With d = b^2(q^2 - r^2)/2 the root is
 * sqrt(d^2 + b^2), alpha^2 + b^2 q^2 = d + root, and its product with beta^2 - b^2 q^2 is b^2. */
static void set_wave_numbers(struct beam_wave *wave, const struct beam_ratios *ratios, double b)
{
    double squared = b * b;
    double half = 0.5 * squared * (ratios->shear - ratios->inertia);
    double root = sqrt(half * half + squared);
    double beta_squared = 0.5 * squared * (ratios->shear + ratios->inertia) + root;

    wave->b = b;
    wave->beta = sqrt(beta_squared);
    wave->alpha_squared =
        squared * (1.0 - squared * ratios->inertia * ratios->shear) / beta_squared;
    wave->alpha = fmax(sqrt(fabs(wave->alpha_squared)), SMALLEST_ALPHA);
    if (half >= 0.0) {
        wave->hyper = half + root;
        wave->trig = squared / wave->hyper;
    } else {
        wave->trig = root - half;
        wave->hyper = squared / wave->trig;
    }
}

struct beam_wave beam_wave_at(const struct beam_ratios *ratios, double b)
{
    struct beam_wave wave;

    set_wave_numbers(&wave, ratios, b);
    if (wave.alpha_squared >= 0.0) {
        double decay = expm1(-wave.alpha); /* tanh(alpha/2) = -decay/(2 + decay) */
        double tanh_half = -decay / (2.0 + decay);
        wave.cosh_end = 1.0;
        wave.sinh_end = tanh_half / wave.alpha;
        wave.sech_squared = 4.0 * (1.0 + decay) / ((2.0 + decay) * (2.0 + decay));
    } else {
        wave.cosh_end = cos(0.5 * wave.alpha);
        wave.sinh_end = sin(0.5 * wave.alpha) / wave.alpha;
        wave.sech_squared = 1.0;
    }
    wave.cos_end = cos(0.5 * wave.beta);
    wave.sin_end = sin(0.5 * wave.beta);
    return wave;
}

static void even_values(const struct beam_wave *wave, enum beam_quantity quantity, double values[2])
{
    switch (quantity) {
    case BEAM_DEFLECTION:
        values[0] = wave->cosh_end;
        values[1] = wave->cos_end;
        break;
    case BEAM_SLOPE:
        values[0] = wave->hyper * wave->sinh_end;
        values[1] = -wave->trig / wave->beta * wave->sin_end;
        break;
    case BEAM_MOMENT:
        values[0] = wave->hyper * wave->cosh_end;
        values[1] = -wave->trig * wave->cos_end;
        break;
    case BEAM_SHEAR:
        values[0] = -wave->sinh_end;
        values[1] = -wave->sin_end / wave->beta;
        break;
    }
}

static void odd_values(const struct beam_wave *wave, enum beam_quantity quantity, double values[2])
{
    double sinh_end = wave->alpha_squared * wave->sinh_end / wave->beta;

    /* hyperbolic and trigonometric part of each, at the end */
    switch (quantity) {
    case BEAM_DEFLECTION:
        values[0] = sinh_end;
        values[1] = wave->sin_end;
        break;
    case BEAM_SLOPE:
        values[0] = wave->hyper / wave->beta * wave->cosh_end;
        values[1] = wave->trig / wave->beta * wave->cos_end;
        break;
    case BEAM_MOMENT:
        values[0] = wave->hyper * sinh_end;
        values[1] = -wave->trig * wave->sin_end;
        break;
    case BEAM_SHEAR:
        values[0] = -wave->cosh_end / wave->beta;
        values[1] = wave->cos_end / wave->beta;
        break;
    }
}

void beam_wave_end_values(const struct beam_wave *wave, enum beam_quantity quantity,
                          enum beam_parity parity, double values[2])
{
    if (parity == BEAM_EVEN)
        even_values(wave, quantity, values);
    else
        odd_values(wave, quantity, values);
}

static const enum beam_quantity held[][2] = {
    [SUPPORT_FREE] = {BEAM_MOMENT, BEAM_SHEAR},
    [SUPPORT_PINNED] = {BEAM_DEFLECTION, BEAM_MOMENT},
    [SUPPORT_CLAMPED] = {BEAM_DEFLECTION, BEAM_SLOPE},
};

/* Size of those of a quantity's values that carry the rounding of a phase, a sine or a cosine of
 * many turns. Divided by it every condition is equally uncertain, and the one with the largest
 * values left is the one to solve; the hyperbolic values are good to the last bits. */
static double uncertainty_of(const struct beam_wave *wave, enum beam_quantity quantity)
{
    double hyper = wave->alpha_squared < 0.0 ? wave->hyper : 0.0;
    double shortest = fmin(0.5, 1.0 / wave->alpha); /* bound of P above the cut-off */

    switch (quantity) {
    case BEAM_SLOPE:
        return fmax(hyper * shortest, wave->trig / wave->beta);
    case BEAM_MOMENT:
        return fmax(hyper, wave->trig);
    case BEAM_SHEAR:
        return fmax(hyper > 0.0 ? shortest : 0.0, 1.0 / wave->beta);
    default:
        return 1.0;
    }
}

void beam_wave_conditions(const struct beam_wave *wave, enum support support,
                          enum beam_parity parity, double rows[2][2])
{
    for (int i = 0; i < 2; i++) {
        enum beam_quantity quantity = held[support][i];
        double scale = 1.0 / uncertainty_of(wave, quantity);

        beam_wave_end_values(wave, quantity, parity, rows[i]);
        rows[i][0] *= scale;
        rows[i][1] *= scale;
    }
}

void beam_wave_coupled_conditions(const struct beam_wave *wave, const enum support supports[2],
                                  double rows[4][4])
{
    for (int end = 0; end < 2; end++) {
        double even[2][2], odd[2][2];
        /* at the left end each quantity of the one class has the opposite sign of the other's */
        double mirror = end == 0 ? -1.0 : 1.0;

        beam_wave_conditions(wave, supports[end], BEAM_EVEN, even);
        beam_wave_conditions(wave, supports[end], BEAM_ODD, odd);
        for (int i = 0; i < 2; i++) {
            rows[2 * end + i][0] = even[i][0];
            rows[2 * end + i][1] = even[i][1];
            rows[2 * end + i][2] = mirror * odd[i][0];
            rows[2 * end + i][3] = mirror * odd[i][1];
        }
    }
}
