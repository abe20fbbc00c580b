/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Micro-slip of a contact whose law has a loss, circle by circle (V. L. Popov, M. Hess, Method of
 * Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015, chapters 5 and 7): as
 * in contact/memory.h a circle is a spring of its own, and has a tangential one beside it, which
 * remembers by the same relaxation (Poisson's ratio is constant). The circle that touches at the
 * indentation y = depth ((c + 1/2)/parts)^2 has the stiffness K = F'(y+) - F'(y-) of the law at
 * rest, and
 *
 *   normal       f = d - y - sum_i share_i m_i,           time_i m_i' = d - y - m_i
 *   tangential   t = kappa (u - sum_i share_i n_i),       time_i n_i' = u - n_i
 *
 * with u the displacement of its foot, which sticks or slips along t so that |t| <= mu f N/sum(K
 * f): the contact's solved force N is shared as the f are. A circle that has parted, f <= 0,
 * recovers freely, f = t = 0. The contact's tangential force is sum K t. Without a relaxation, as
 * of a law of the rate alone, the springs are elastic and only the limits follow the loss. */
#ifndef PERCUSS_CONTACT_CIRCLES_H
#define PERCUSS_CONTACT_CIRCLES_H

#include "base/arena.h"
#include "contact/law.h"
#include "contact/recovery.h"
#include "model/relaxation.h"

/* Axes of a circle: the normal and both tangents. */
enum { CIRCLE_AXES = 3 };

struct circles {
    const struct contact_law *law;       /* borrowed */
    const struct relaxation *relaxation; /* its own, or none: elastic springs */
    const struct recovery_modes *modes;  /* of the relaxation; NULL without one */
    double coefficient;                  /* mu > 0 */
    double ratio[3], over_ratio[3];      /* kappa: xx, xy, yy; and its inverse */
    size_t parts, count;                 /* circles up to the depth, and all */
    double deep;                         /* that depth, m */
    double *depth, *stiffness;           /* [count]: y, m, and K, N/m */
    double *pressed;                     /* [count]: f of the last walk, m */
    /* the history */
    size_t reached;                      /* circles that have touched */
    double *moved[CIRCLE_AXES];          /* [count]: d - y, or what is left of it, and u, m */
    double *memory[CIRCLE_AXES];         /* [term count]: m_i and n_i, m */
    double *drawn[2];                    /* [count]: t, over K, m */
    double indentation, displacement[2]; /* m */
    double force[2];                     /* N */
    double stuck;      /* stiffness of the circles that stick, N/m, not times kappa */
    double resists[3]; /* slope of the force by the displacement along each tangent, N/m: of circles
                          that stick, and across the force of those that slip; and between both */
    double stored;     /* what the springs give back in the end, J */
};

/* Where a way ends: indentation and displacement (m), the contact's force (N), and the time that it
 * takes (s); all in proportion. */
struct circles_target {
    double indentation, displacement[2], normal, time;
};

/* Without a history, with `parts` > 0 circles up to the depth, from the arena. The law, which has a
 * loss, is borrowed. False: no memory. */
bool circles_create(struct circles *circles, const struct contact_law *law, double coefficient,
                    const double ratio[3], size_t parts, struct arena *arena);

/* A second history of the same circles, at their first touch: for ways that are tried. False: no
 * memory. */
bool circles_second(struct circles *second, const struct circles *circles, struct arena *arena);

/* A contact phase begins, `time` (s) after the last one, at an indentation <= 0 (m) and this
 * displacement: the circles divide the indentations by `depth` (m), about the largest one (sixteen
 * times as much is as fine). They have recovered freely since, or, where the depth is another one,
 * from the beginning. */
void circles_touch(struct circles *circles, double depth, double time, double indentation,
                   const double displacement[2]);

/* Copies the history. */
void circles_copy(struct circles *to, const struct circles *from);

/* Goes on to a target: force, slopes and store become those there. */
void circles_walk(struct circles *circles, const struct circles_target *to);

#endif
