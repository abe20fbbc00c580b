/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Axisymmetric quadrilateral of four nodes, 2 x 2 Gauss points, with the volume change of the whole
 * element in place of each point's (B-bar; Hughes, The Finite Element Method, section 4.5.2): does
 * not lock when plastic flow keeps the volume. */
#ifndef PERCUSS_FE_QUAD_H
#define PERCUSS_FE_QUAD_H

#include <stdbool.h>

#include "fe/plasticity.h"

enum { QUAD_POINTS = 4, QUAD_FREEDOMS = 8 };

/* Strains rr, zz, tt, rz (engineering) at a point from the displacements r0 z0 r1 z1 ... */
struct quad {
    double strain[QUAD_POINTS][STRESS_COMPONENTS][QUAD_FREEDOMS];
    double volume[QUAD_POINTS]; /* m^3, of the ring that the point stands for */
};

/* False where a corner is not convex or the element lies across the axis. */
bool quad_make(const double r[4], const double z[4], struct quad *quad);

/* force += integral of strain^T stress at a point, N. */
void quad_add_force(const struct quad *quad, int point, const double stress[STRESS_COMPONENTS],
                    double force[QUAD_FREEDOMS]);

/* stiffness (8 x 8, row-major) += integral of strain^T moduli strain at a point. */
void quad_add_stiffness(const struct quad *quad, int point,
                        const double moduli[STRESS_COMPONENTS * STRESS_COMPONENTS],
                        double stiffness[QUAD_FREEDOMS * QUAD_FREEDOMS]);

/* Strain at a point from the element's displacements. */
void quad_strain(const struct quad *quad, int point, const double displacement[QUAD_FREEDOMS],
                 double strain[STRESS_COMPONENTS]);

/* Properties of an element for explicit dynamics. */

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
