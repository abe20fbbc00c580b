/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Rigid motions that a body's supports allow, and their change by an impulse. */
#ifndef PERCUSS_MODEL_RIGID_H
#define PERCUSS_MODEL_RIGID_H

#include "model/body.h"

/* Velocity of the point (body frame) along direction_i due to a unit impulse along direction_j at
 * point_j, 1/kg: direction_i^T M^-1 direction_j of one body. Free: 1/m + rotation. A beam pinned at
 * one end and free at the other turns about the pin; any other supported body and a half-space do
 * not move: 0. */
double rigid_inverse_mass(const struct body *body, const double point_i[3],
                          const double direction_i[3], const double point_j[3],
                          const double direction_j[3]);

/* Change of the centre of mass's velocity and of the angular velocity (both body frame, added to)
 * due to an impulse vector (body frame, N s) at a point. */
void rigid_apply_impulse(const struct body *body, const double point[3], const double impulse[3],
                         double velocity[3], double angular_velocity[3]);

#endif
