/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The problem of one contact as a general integrator gets to see it: y = (z, v), where z_0 = -gap
 * and z_k = -participation_k q_k, so that the approach is the plain sum of all z and
 *
 *   z_k'' = -square_k z_k - push_k F,   F = law(sum z - residual F),
 *
 * with square_0 = 0, push_0 = W, push_k = participation_k^2. Undamped, without acceleration, Hertz.
 */
#ifndef PERCUSS_BENCH_CONTACT_ODE_H
#define PERCUSS_BENCH_CONTACT_ODE_H

#include "impact/motion.h"

struct contact_ode {
    const struct scene *scene;
    size_t count, stride;  /* of z; padded with zeros to whole vectors */
    double *square, *push; /* [stride] */
    double *omega;         /* [stride], 0 for the rigid part and the padding */
    double stiffness, residual;
    double speed;     /* of the approach */
    double magnitude; /* of the indentation */
    double tangent;   /* dF/d(sum z) at the last evaluation, for Newton's method */
};

/* Arrays come from the arena. False: out of memory, or not such a problem. */
bool contact_ode_create(struct contact_ode *ode, const struct scene *scene, struct arena *arena);

/* rate = f(y); both 2 stride numbers. */
void contact_ode_rate(struct contact_ode *ode, const double *y, double *rate);

/* Sum of all z. */
double contact_ode_approach(const struct contact_ode *ode, const double *z);

/* Contact force at an approach. */
double contact_ode_force(struct contact_ode *ode, double approach);

/* x with x - gamma J x = b, J the Jacobian at the last evaluation, in place: with D = 1 + gamma^2
 * square the positions obey (D + gamma^2 tangent push 1^T) z = b_z + gamma b_v, a diagonal matrix
 * plus one of rank one. */
void contact_ode_newton(const struct contact_ode *ode, double gamma, double *x);

/* Absolute tolerances [2 stride] for a relative one: a share of the approach's energy in every mode
 * (`energetic`), or the same displacement and velocity for all. */
void contact_ode_weights(const struct contact_ode *ode, double tolerance, bool energetic,
                         double *absolute);

/* Vibration can cause no further contact. */
bool contact_ode_complete(const struct contact_ode *ode, const double *y);

/* To and from the library's state. */
void contact_ode_pack(const struct contact_ode *ode, const struct motion *motion, double *y);
void contact_ode_unpack(const struct contact_ode *ode, const double *y, struct motion *motion);

#endif
