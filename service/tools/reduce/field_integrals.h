/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Integrals of the half-space's fields of a place's loads over a mesh's surface and volume, for the
 * flexibility (flexibility.h). Columns of several loads stand one behind the other. */
#ifndef PERCUSS_REDUCE_FIELD_INTEGRALS_H
#define PERCUSS_REDUCE_FIELD_INTEGRALS_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/element.h"
#include "mesh/solid_mesh.h"
#include "reduce/flexibility_place.h"

/* One number for each pair of a place's loads, which the mean of it and its mirror image makes
 * symmetric (m/N). */
typedef double load_pairs[FLEXIBILITY_LOADS][FLEXIBILITY_LOADS];

/* Owns its arrays; the mesh is borrowed. */
struct volume_rule {
    const struct solid_mesh *mesh;
    struct element_rule *rules; /* [ELEMENT_TYPES] */
    size_t *first;       /* [element_count + 1]: an element's points are points[first[e]] .. */
    double (*points)[4]; /* place, volume: m, m^3 */
    double (*centres)[3], *radii; /* [element_count], m */
    size_t *first_mass; /* [element_count + 1]: an element's masses are masses[first_mass[e]] .. */
    double *masses;     /* integral of rho N_i N_j, by rows up to the diagonal, kg */
};

/* False: no memory. */
bool volume_rule_make(struct volume_rule *rule, const struct solid_mesh *mesh);
void volume_rule_free(struct volume_rule *rule);

/* With the fields' tractions t and displacements u: subtracts the nodal forces that do t's work,
 * the integral of N^T t, from forces ([loads][n], N), and the integral of t.u outside the place's
 * cut from `values`. */
void field_integrals_surface(const struct surface_rule *rule, const struct flexibility_place *place,
                             size_t n, double *forces, load_pairs values);

/* The fields' displacements u as mass feels them, the integral of rho N^T u, in two parts: u at the
 * nodes (`nodal`, [loads][3 node_count], m/N; 0 right beside the place but where `held` (NULL:
 * nowhere) says so), which M, the mesh's mass matrix, makes a momentum of; and `beyond`, as large,
 * kg m/N, what the integral is beyond that. It is 0 but at elements near the place, as the shape
 * functions of others hold the field. */
void field_integrals_mass(const struct volume_rule *rule, const struct flexibility_place *place,
                          const bool *held, double *nodal, double *beyond);

/* Where other materials than the place's lie, the field's stress there is not the half-space's: D'
 * the place's elasticity, D the part's, e the field's strain. Adds the nodal forces of (D' - D) e
 * to forces ([loads][3 node_count]) and their work on e to `values`. 0 in a body of one material.
 */
void field_integrals_parts(const struct volume_rule *rule, const struct flexibility_place *place,
                           double *forces, load_pairs values);

/* Held freedoms are shifted by each load (`shifts`, [loads][3 node_count], zero at all others):
 * subtracts the forces K times shifts from forces, and their work on the shifts from `values`. */
void field_integrals_shifts(const struct volume_rule *rule, const bool *held, int loads,
                            const double *shifts, double *forces, load_pairs values);

#endif
