/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* J2 plasticity with bilinear isotropic hardening, small strains, axisymmetric. Stresses and
 * strains are four components: rr, zz, tt (hoop), rz; the strain's rz is the engineering one,
 * gamma. */
#ifndef PERCUSS_FE_PLASTICITY_H
#define PERCUSS_FE_PLASTICITY_H

#include <stdbool.h>

#include "model/material.h"
#include "model/yield_rate.h"

enum { STRESS_COMPONENTS = 4 };

struct plastic_law {
    double bulk, shear; /* Pa */
    double yield;       /* first yield stress, Pa; INFINITY: elastic */
    double hardening;   /* slope of yield stress over accumulated plastic strain, Pa */
};

/* History of one material point; all zero when virgin. */
struct plastic_state {
    double strain[STRESS_COMPONENTS]; /* plastic, deviatoric; rz engineering */
    double accumulated;               /* sqrt(2/3) of the length of its path */
};

/* Bilinear in uniaxial tension: slope E up to the yield stress, E_t beyond; the hardening modulus
 * is E E_t / (E - E_t). Needs tangent < young. */
struct plastic_law plastic_law_make(const struct material *material);

/* Stress at a total strain, reached from the history `before` by radial return (backward Euler;
 * Simo and Hughes, Computational Inelasticity, box 3.2). `after` may be `before`. `tangent`,
 * row-major and symmetric, is the consistent one; NULL where it is not wanted. Returns whether it
 * flowed. */
bool plasticity_return(const struct plastic_law *law, const struct plastic_state *before,
                       const double strain[STRESS_COMPONENTS], struct plastic_state *after,
                       double stress[STRESS_COMPONENTS],
                       double tangent[STRESS_COMPONENTS * STRESS_COMPONENTS]);

/* Increment of the accumulated strain in a step (s) whose trial stress has the equivalent `trial`
 * beyond yield (Pa), where the yield stress grows with the rate of this strain: the root of
 * trial - 3 G increment = (yield + hardening (accumulated + increment)) factor(increment / step),
 * backward Euler in the rate too. `stated` depends on the rate. */
double plasticity_increment(const struct plastic_law *law, const struct yield_rate *stated,
                            double accumulated, double trial, double step);

/* Elastic moduli, row-major. */
void plastic_law_moduli(const struct plastic_law *law,
                        double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS]);

/* Von Mises equivalent of a stress. */
double stress_equivalent(const double stress[STRESS_COMPONENTS]);

#endif
