/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mass properties of a mesh: volume, mass, centre, inertia, by the elements' own quadrature, with
 * the masses on its nodes. */
#ifndef PERCUSS_MESH_BULK_H
#define PERCUSS_MESH_BULK_H

#include "mesh/solid_mesh.h"

struct bulk {
    size_t element_count;
    double volume;       /* m^3 */
    double mass;         /* kg; each part has its material */
    double nodes_mass;   /* that of masses on nodes, part of it, kg */
    double centre[3];    /* of mass, m, in the mesh's frame */
    double inertia[9];   /* about the centre of mass, kg m^2, row-major */
    double smallest_det; /* det J over its element's mean: 1 is an undistorted element, <= 0 none */
    size_t smallest_at;  /* its element */
    double smallest_volume, largest_volume; /* of one element, m^3 */
};

/* Evaluates det J in the points of quadrature and in the nodes. */
void bulk_of(const struct solid_mesh *mesh, struct bulk *bulk);

/* The same of one part alone, an index of mesh->part, without masses on nodes. */
void bulk_of_part(const struct solid_mesh *mesh, size_t part, struct bulk *bulk);

/* The smallest det J of an element over its mean, and its volume. */
double bulk_element_det(const struct solid_mesh *mesh, size_t element, double *volume);

#endif
