/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Moduli of linear viscoelastic materials as sums of exponentials (Prony's series): after a sudden
 * strain the modulus falls from its instantaneous value E_0 to E_0 g(t),
 *
 *   g(t) = 1 - sum_i share_i (1 - exp(-t/time_i))
 *
 * Poisson's ratio is constant. */
#ifndef PERCUSS_MODEL_RELAXATION_H
#define PERCUSS_MODEL_RELAXATION_H

#include <stddef.h>

/* Terms of a material, and of two in series. */
enum { RELAXATION_TERMS = 8, RELAXATION_MOST = 2 * RELAXATION_TERMS };

struct relaxation {
    size_t count;                  /* 0: elastic */
    double share[RELAXATION_MOST]; /* of the instantaneous modulus, > 0; their sum < 1 */
    double time[RELAXATION_MOST];  /* s, ascending */
};

/* Storage modulus over the instantaneous one, and loss factor tan delta, of steady vibration at an
 * angular frequency (rad/s). */
double relaxation_storage(const struct relaxation *relaxation, double omega);
double relaxation_loss_factor(const struct relaxation *relaxation, double omega);

/* The largest loss factor of all frequencies from `omega` on, to 1 %; 0: of all. */
double relaxation_peak_loss(const struct relaxation *relaxation, double omega);

/* Adds a term, in order of time; one of a time that is there already is added to that. There is
 * room for RELAXATION_MOST. */
void relaxation_add(struct relaxation *relaxation, double share, double time);

/* The terms that a motion of about this frequency tells from springs: without those that are a
 * million times faster, which it finds relaxed, or slower, which it finds stiff. The instantaneous
 * modulus is then *stiffness times what it was. */
struct relaxation relaxation_near(const struct relaxation *relaxation, double omega,
                                  double *stiffness);

/* A material with this loss factor (0 < eta < 2) at `omega`, and nearly the same around it (up to
 * 0.3: to 10 % from omega/20 to 6 omega): its modulus grows there like omega^a, a = 2/pi atan eta
 * (J. D. Ferry, Viscoelastic Properties of Polymers, 1980, chapter 3: modulus, loss and spectrum of
 * a power of time). */
struct relaxation relaxation_constant(double loss_factor, double omega);

/* Its creep: the deformation under a sudden load grows to 1 + sum_i share_i (1 - exp(-t/time_i)) of
 * the instantaneous one. As many terms; each time is longer than that of the same index of the
 * modulus, and shorter than the next one. */
struct relaxation relaxation_creep(const struct relaxation *relaxation);

/* Two bodies in series, the first with `part` (0 to 1) of the instantaneous compliance: their creep
 * adds. Each has up to RELAXATION_TERMS terms. */
struct relaxation relaxation_in_series(const struct relaxation *first, double part,
                                       const struct relaxation *second);

#endif
