/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Half-space z <= 0 under a point load of 1 N at the origin, pressing in -z (Johnson, Contact
 * Mechanics, section 3.4). */
#ifndef PERCUSS_FE_BOUSSINESQ_H
#define PERCUSS_FE_BOUSSINESQ_H

#include "fe/plasticity.h"

/* Displacement (r, z) in m/N at r >= 0, z <= 0, off the origin; zero at infinity. */
void boussinesq_displacement(double young, double poisson, double r, double z,
                             double displacement[2]);

/* Stress rr, zz, tt, rz per N. */
void boussinesq_stress(double poisson, double r, double z, double stress[STRESS_COMPONENTS]);

#endif
