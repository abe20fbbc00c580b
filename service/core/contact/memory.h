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
 * (tests/unit/impact/test_memory_step.c).
 * Circles that have parted are taken to follow the ball until the contact grows again or has
 * parted.
 *
 * A circle that has parted recovers freely (contact/recovery.h). The memory of all circles, M_i =
 * 3/4 int m_i y^(-1/2) dy, is known whatever is pressed, as f = 0 where nothing is: time_i M_i' =
 * F/k + sum_j share_j M_j - M_i. So are the m_i(0) of the middle, which parts last. Where the
 * contact has parted, or begins to grow again, the surface is taken to have the form that both have
 * at the turn, with the width of the widest circle that was pressed.
 *
 * When it grows on that surface, whose free displacement is u0(y, t), all is as the first time with
 *
 *   w(y) = d - y - u0(y)     in the place of d - y,     G = 3/4 int w y^(-1/2) dy over w > 0
 *
 * in that of d^(3/2): the equations are linear, and a circle touches where w = 0. Where it begins
 * to shrink, both memories are added. */
#ifndef PERCUSS_CONTACT_MEMORY_H
#define PERCUSS_CONTACT_MEMORY_H

#include <stdbool.h>

#include "contact/recovery.h"
#include "model/relaxation.h"

/* m_i(y) = center_i + slope_i y + bend_i y^2 while it shrinks; lengths in m. While it grows: by
 * what has happened since it touched. */
struct contact_memory {
    const struct relaxation *relaxation;
    const struct recovery_modes *modes; /* of the relaxation */
    bool shrinks;
    double width;                   /* y_m, or that of what was left if it is more; it shrinks */
    double center[RELAXATION_MOST]; /* of y = 0 */
    double total[RELAXATION_MOST];  /* M_i, while it grows, m^(3/2) */
    double slope[RELAXATION_MOST], bend[RELAXATION_MOST];
    struct recovery left; /* before it touched, free since; while it shrinks `total` is of all */
};

/* Nothing has happened yet. Relaxation and modes are borrowed. */
void contact_memory_begin(struct contact_memory *memory, const struct relaxation *relaxation,
                          const struct recovery_modes *modes);

/* The contact begins to shrink at a width > 0: the indentation, where nothing was left. */
void contact_memory_shrink(struct contact_memory *memory, double width);

/* One that shrinks has parted, or begins to grow again: all that it remembers is what is left. */
void contact_memory_renew(struct contact_memory *memory);

/* The first root of a parabola that falls at y = 0, at most the width, below 0 where it does not
 * press; or an indentation beyond the width. */
double contact_memory_edge(double indentation, const double pressed[3], double width);

/* Force (N) of a contact that grows: `raised` = d^(3/2) or G, `remembered` = sum share_i M_i;
 * *stiffness becomes the force's slope by `raised`. Never negative. */
double contact_memory_growing(double k, double raised, double remembered, double *stiffness);

/* Force (N) of one that shrinks: f(y) = pressed[0] + pressed[1] y + pressed[2] y^2 up to the
 * width, and d - y from there to the indentation; *stiffness becomes its slope by pressed[0], and
 * by d beyond the width. Never negative. */
double contact_memory_shrinking(double k, double indentation, const double pressed[3], double width,
                                double *stiffness);

#endif
