/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The waves of a straight uniform bar as families of modes, x from -length/2 to +length/2. */
#ifndef PERCUSS_MODEL_BAR_WAVES_H
#define PERCUSS_MODEL_BAR_WAVES_H

#include <stdbool.h>
#include <stddef.h>

#include "model/body.h"
#include "model/body_kind.h"

/* Longitudinal: omega_k = k pi c/L (free-free), (k - 1/2) pi c/L (one end held), with Rayleigh-Love
 * omega/sqrt(1 + (nu k r_p)^2). Driven by forces along x. */
extern const struct mode_family longitudinal_family;

/* Bending (beam.h) in the plane y as BAR_BENDING_Y, in the plane z as BAR_BENDING_Z; shapes are
 * struct beam_unit_mode. */
extern const struct mode_family beam_bending_family;

/* Twist theta about the axis, by a load's moment, with warping of the section (Vlasov 1961):
 *   rho I_p theta_tt - rho Gamma theta_xxtt = G J theta_xx - E Gamma theta_xxxx.
 * Gamma = 0, a round section, is Saint-Venant's bar. A support, pinned or clamped, holds the twist
 * and leaves the section free to warp. */
extern const struct mode_family beam_twist_family;

/* Two constants of the section, which body_complete keeps; the other functions take a completed
 * body. */

/* Saint-Venant's torsion constant J of the section, m^4: pi r^4/2 of a circle, the series for a
 * rectangle (Timoshenko and Goodier, Theory of Elasticity, section 109), relative error 1e-15. */
double torsion_constant(const struct body *body);

/* Warping constant Gamma = integral over the section of the squared warping function of that
 * solution, m^6: 0 of a circle, w^3 h^3/144 of a thin rectangle. */
double torsion_warping_constant(const struct body *body);

/* Frequency (rad/s) of elastic mode k = 0, 1, ..., ascending. */
double torsion_frequency(const struct body *body, size_t k);

/* Rotation (rad) at x for unit modal coordinate of mode k of frequency `omega`; mass-normalised:
 * integral of rho I_p theta^2 + rho Gamma theta'^2 = 1. */
double torsion_shape(const struct body *body, size_t k, double omega, double x);

/* Whether the shape is odd about the middle; never between unlike supports. */
bool torsion_is_odd(const struct body *body, size_t k);

/* Static rotation at x_i due to a unit torque at x_j, rad/(N m); of a free beam with the torque
 * balanced by the inertia of its rigid rotation and that rotation taken off: the sum of
 * shape_i shape_j/omega^2 over all modes. */
double torsion_compliance(const struct body *body, double x_i, double x_j);

#endif
