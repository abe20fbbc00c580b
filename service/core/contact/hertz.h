/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Hertz contact of two general second-order surfaces, exact elliptic solution. */
#ifndef PERCUSS_CONTACT_HERTZ_H
#define PERCUSS_CONTACT_HERTZ_H

#include "model/material.h"

/* Below this ratio of the relative principal curvatures a contact counts as a line. */
#define HERTZ_LINE_RATIO 1e-6
/* Above this axis ratio it counts as circular: the error of laws of circles is below 1e-6. */
#define HERTZ_CIRCULAR_RATIO 0.999
/* Peak pressure over the yield stress where metal first flows, below the surface: of a circle at
 * nu = 0.3 (Johnson, Contact Mechanics, section 6.1); of ellipses it is up to 1.79. */
#define HERTZ_FIRST_YIELD 1.6
/* The work of k d^(3/2), of force times indentation. */
#define HERTZ_WORK 0.4
/* An elastic collision by k d^(3/2): its duration over indentation / speed of approach (Johnson,
 * section 11.4); the mean stiffness over peak force / indentation, weighted by the force; and for
 * effects of slow forces, with K = dF/dd and d'^2 = v^2 (1 - (d/d_m)^(5/2)), the integral of K' F'
 * over k^2 v d_m, and that of F'^2 times the speed over the one of K' F' times the indentation. */
#define HERTZ_DURATION       2.94
#define HERTZ_MEAN_STIFFNESS 1.3
#define HERTZ_SLOW_INERTIA        1.78
#define HERTZ_SLOW_VISCOSITY      0.9

struct hertz_contact {
    double effective_modulus; /* E*, Pa */
    double stiffness;         /* k of F = k d^(3/2), N/m^(3/2) */
    double axis_ratio;        /* b / a <= 1 of the contact ellipse */
    double curvature[2];      /* A <= B of the gap A x^2 + B y^2, 1/m */
    double integral;          /* R_D(0, q, 1) with q = axis_ratio^2 */
};

/* 1/E* = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b. */
double hertz_effective_modulus(const struct material *a, const struct material *b);

/* Contact of relative curvatures A <= B (1/m), A > 0: A = 1/(2 R1), B = 1/(2 R2) (Johnson, Contact
 * Mechanics, section 4.2; with m = 1 - (b/a)^2: B/A = [(a/b)^2 E - K]/(K - E), G = (K - E)/(m A),
 * k = (2 pi E-star/3) sqrt(G)/K^(3/2)). */
struct hertz_contact hertz_contact_make(double effective_modulus, double a, double b);

/* Semi-axes (a, b), m, of the contact ellipse at a force. */
void hertz_ellipse(const struct hertz_contact *contact, double force, double axes[2]);

/* Largest pressure at a force, Pa: 3 F / (2 pi a b). */
double hertz_peak_pressure(const struct hertz_contact *contact, double force);

/* The same over that of the circular contact of equal stiffness: 1 for circles, 1.05 where the axes
 * are as 0.54 to 1, 1.56 where as 0.14. */
double hertz_pressure_ratio(const struct hertz_contact *contact);

#endif
