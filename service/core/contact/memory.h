/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Hertz's contact of linear viscoelastic bodies, and what it remembers.
 *
 * A circle of the contact is a spring of its own (Popov's reduction of dimensions; exact for
 * half-spaces, also viscoelastic ones: Argatov and Popov, ZAMM 96 (2016) 956). The circle with the
 * depth y = x^2/R below the ball touches where the indentation d exceeds y. With the instantaneous
 * stiffness k, its force and the contact's are
 *
 *   f(y) = d - y - sum_i share_i m_i(y),     time_i m_i' = d - y - m_i
 *   F = 3/4 k int f(y) y^(-1/2) dy           over the circles that touch
 *
 * While the contact grows, all circles up to y = d touch, and the sums over them are those of Lee
 * and Radok (J. Appl. Mech. 27 (1960) 438): F = k (d^(3/2) - sum share_i M_i), time_i M_i' =
 * d^(3/2) - M_i. While it shrinks a circle parts where f(y) = 0, earlier than y = d: this is Ting's
 * rule (J. Appl. Mech. 33 (1966) 845). For it m_i(y) must be known over y. When the contact begins
 * to shrink at a width y_m = d, it is taken as
 *
 *   m_i(y) = center_i (1 - t_i) (1 - y/y_m) + center_i t_i (1 - y/y_m)^2
 *
 * with t_i from M_i (the true m_i goes with (y_m - y)^(3/2) for long times, and with (y_m - y) for
 * short ones). From there on it stays a parabola, and so does f(y). Against the circles themselves
 * this leaves at most 0.0011 in the restitution of a standard solid, for loss factors up to 1.8
 * (tests/unit/impact/test_memory_step.c). Circles that have parted are taken to follow the ball;
 * this matters only where the contact grows again before it has opened. A contact that has opened
 * remembers nothing when it closes again. */
#ifndef PERCUSS_CONTACT_MEMORY_H
#define PERCUSS_CONTACT_MEMORY_H

#include <stdbool.h>

#include "model/relaxation.h"

/* m_i(y) = center_i + slope_i y + bend_i y^2 while it shrinks; lengths in m. */
struct contact_memory {
    const struct relaxation *relaxation;
    bool shrinks;
    double width;                   /* y_m, while it shrinks */
    double center[RELAXATION_MOST]; /* of y = 0 */
    double total[RELAXATION_MOST];  /* M_i, while it grows, m^(3/2) */
    double slope[RELAXATION_MOST], bend[RELAXATION_MOST];
};

/* Nothing has happened yet. */
void contact_memory_begin(struct contact_memory *memory, const struct relaxation *relaxation);

/* The contact begins to shrink at an indentation > 0, or grows again beyond its width. */
void contact_memory_shrink(struct contact_memory *memory, double indentation);
void contact_memory_grow(struct contact_memory *memory);

/* Force (N) of a contact that grows, `remembered` = sum share_i M_i; *stiffness becomes the force's
 * slope by d^(3/2). Never negative. */
double contact_memory_growing(double k, double indentation, double remembered, double *stiffness);

/* Force (N) of one that shrinks: f(y) = pressed[0] + pressed[1] y + pressed[2] y^2 up to the
 * width, and d - y from there to the indentation; *stiffness becomes its slope by pressed[0], and
 * by d beyond the width. Never negative. */
double contact_memory_shrinking(double k, double indentation, const double pressed[3], double width,
                                double *stiffness);

#endif
