/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Integrals over a body's volume of the half-space's field that belongs to a force at a place. */
#ifndef PERCUSS_REDUCE_FLEXIBILITY_VOLUME_H
#define PERCUSS_REDUCE_FLEXIBILITY_VOLUME_H

#include <stdbool.h>
#include <stddef.h>

#include "mesh/element.h"
#include "reduce/flexibility_place.h"

enum { VOLUME_RULE_TYPES = ELEMENT_HEX27 + 1 };

/* Owns its arrays; the mesh is borrowed. */
struct volume_rule {
    const struct solid_mesh *mesh;
    struct element_rule *rules; /* [VOLUME_RULE_TYPES] */
    size_t *first;       /* [element_count + 1]: an element's points are points[first[e]] .. */
    double (*points)[4]; /* place, volume: m, m^3 */
    double (*centres)[3], *radii; /* [element_count], m */
};

/* False: no memory. */
bool volume_rule_make(struct volume_rule *rule, const struct solid_mesh *mesh);
void volume_rule_free(struct volume_rule *rule);

/* Adds the field's displacements u as mass feels them, the integral of rho N^T u, to momentum
 * ([3 node_count], kg m/N). */
void flexibility_volume_add_mass(const struct volume_rule *rule,
                                 const struct flexibility_place *place, double *momentum);

/* Where other materials than the place's lie, the field's stress there is not the half-space's: D'
 * the place's elasticity, D the part's, e the field's strain. Adds the nodal forces of (D' - D) e
 * to force and returns its work on e. 0 in a body of one material. */
double flexibility_volume_add_parts(const struct volume_rule *rule,
                                    const struct flexibility_place *place, double *force);

/* Held nodes are shifted (`shifts`, [3 node_count], zero at all others): subtracts the forces K
 * times shifts from force, adds the mass M times shifts to momentum, and returns the work of the
 * first on the shifts. */
double flexibility_volume_add_shifts(const struct volume_rule *rule, const bool *held,
                                     const double *shifts, double *force, double *momentum);

#endif
