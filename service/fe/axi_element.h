/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The axisymmetric quadrilateral: four nodes, 2 x 2 points, mean dilatation (Hughes 1980, "B-bar"):
 * no volumetric locking, no hourglass modes. Small strains. */
#ifndef PERCUSS_FE_AXI_ELEMENT_H
#define PERCUSS_FE_AXI_ELEMENT_H

#include <stdbool.h>

#include "model/material.h"

enum { AXI_NODES = 4, AXI_POINTS = 4, AXI_DOFS = 8 };

/* Nodes counter-clockwise in (r, z); displacement i is u_r of node i/2 (even) or u_z (odd). */
struct axi_element {
    double gradient[AXI_POINTS][AXI_NODES][3]; /* dN/dr, dN/dz, N/r, 1/m */
    double weight[AXI_POINTS];                 /* 2 pi r |J|, m^3 */
    double share[AXI_NODES];                   /* integral of N, m^3: lumped mass / density */
    double mean[AXI_DOFS];                     /* mean dilatation for a unit displacement, 1/m */
    double volume;                             /* m^3 */
};

/* From the coordinates (r, z) of the nodes, m; false: turned over or degenerate. */
bool axi_element_make(struct axi_element *element, const double at[AXI_NODES][2]);

/* Elastic stiffness, N/m. */
void axi_element_stiffness(const struct axi_element *element, const struct material *material,
                           double stiffness[AXI_DOFS][AXI_DOFS]);

/* Largest angular frequency of the elastic element with its own lumped mass, rad/s: never less than
 * that of any mesh it is part of. */
double axi_element_highest_frequency(const struct axi_element *element,
                                     const struct material *material);

/* The largest von Mises stress at the points for elastic displacements `u`, Pa. */
double axi_element_mises(const struct axi_element *element, const struct material *material,
                         const double u[AXI_DOFS]);

#endif
