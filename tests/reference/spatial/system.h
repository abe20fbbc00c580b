/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Stiffness and mass of a refined mesh in blocks of the nodes that do not hang; x = 0 and y = 0 are
 * planes of symmetry. A vector has three numbers for each of these nodes; those across a plane of
 * symmetry are 0 and stay so. */
#ifndef PERCUSS_SPATIAL_SYSTEM_H
#define PERCUSS_SPATIAL_SYSTEM_H

#include "spatial/refined.h"

enum { BRICK_FREEDOMS = 3 * BRICK_NODES };

/* Stiffness (N/m) of freedom 3 node + direction, mass (kg) of one direction of a
 * brick (mesh/element.h), the map of which may be mirrored. False: the map folds. */
bool brick_matrices(double points[ELEMENT_MOST_NODES][3], const struct material *material,
                    double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                    double mass[BRICK_NODES][BRICK_NODES]);

/* Owns its arrays. */
struct system3 {
    size_t nodes, freedoms; /* 3 nodes */
    size_t *index;          /* [mesh nodes]: its number here; SIZE_MAX: it hangs */
    bool *held;             /* [freedoms] */
    /* node blocks of the upper triangle, rows ascending: columns[first[i]] = i is the first */
    size_t *first, *columns;
    double (*stiffness)[9]; /* row-major, N/m; 0 where either freedom is held */
    double *mass;           /* kg, of each direction */
    double (*points)[3];    /* [nodes], m */
    double whole;           /* kg */
};

/* OK, or INTERNAL: no memory, a brick that folds. */
enum percuss_status system3_create(const struct refined *mesh, const struct material *material,
                                   struct system3 *system, struct fault *fault);
void system3_free(struct system3 *system);

/* result = K x; result = M x. */
void system3_stiffness(const struct system3 *system, const double *x, double *result);
void system3_mass(const struct system3 *system, const double *x, double *result);

/* Mean of direction `c` weighted with mass: a rigid motion's. */
double system3_mean(const struct system3 *system, const double *x, int c);

#endif
