/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Properties of an element for explicit dynamics. */
#ifndef PERCUSS_FE_QUAD_DYNAMICS_H
#define PERCUSS_FE_QUAD_DYNAMICS_H

#include "fe/quad.h"

enum { QUAD_NODES = 4 };

/* dN/dr, dN/dz and N/r of the nodes at a point, 1/m: the strains without their mean change of
 * volume. */
void quad_slopes(const struct quad *quad, int point, double slope[QUAD_NODES][3]);

/* Change of volume, the same at all points, for a unit displacement, 1/m. */
void quad_dilatation(const struct quad *quad, double dilatation[QUAD_FREEDOMS]);

/* Integral of each shape function, m^3: lumped mass / density. */
void quad_shares(const struct quad *quad, double share[QUAD_NODES]);

/* Elastic stiffness, N/m. */
void quad_elastic_stiffness(const struct quad *quad, const struct material *material,
                            double stiffness[QUAD_FREEDOMS][QUAD_FREEDOMS]);

/* Largest angular frequency of the elastic element with its own lumped mass, rad/s: no mesh it is
 * part of has a higher one (Irons). NAN where the eigenvalues fail. */
double quad_highest_frequency(const struct quad *quad, const struct material *material);

/* The largest von Mises stress at the points for elastic displacements `u`, Pa. */
double quad_mises(const struct quad *quad, const struct material *material,
                  const double u[QUAD_FREEDOMS]);

#endif
