/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The vibration of a free elastic box by Ritz's method in three dimensions: displacements are sums
 * of products of Legendre polynomials in x, y and z, which are orthonormal in the box, so that the
 * mass matrix is the identity and the stiffness matrix a sum of products of integrals in closed
 * form (Leissa and Zhang, J. Acoust. Soc. Am. 73 (1983) 2013). Displacements even and odd about
 * the three planes of symmetry do not mix: eight classes.
 *
 * A box has Young's modulus 1, density 1 and a longest side of 1; its origin is its centre. */
#ifndef PERCUSS_MODEL_RITZ_H
#define PERCUSS_MODEL_RITZ_H

#include <stdbool.h>
#include <stddef.h>

struct ritz;

/* Whether a box is within what polynomials reach: no thinner than 1/200 of its length. */
bool ritz_reaches(const double sides[3]);

/* Of these proportions. It takes milliseconds for a compact box and seconds for a thin plate, and
 * is immutable. NULL: out of memory. */
struct ritz *ritz_create(const double sides[3], double poisson);
void ritz_free(struct ritz *ritz); /* NULL is allowed */

/* Whether it is of these proportions, to the last bit. */
bool ritz_is_of(const struct ritz *ritz, const double sides[3], double poisson);

/* Elastic modes, ascending: as many as the polynomials resolve to some 1e-3. */
size_t ritz_mode_count(const struct ritz *ritz);
const double *ritz_omega(const struct ritz *ritz);

/* Displacements along `direction` at a point of the modes first, ... first + count - 1, for unit
 * coordinates; each computed by itself. */
void ritz_shapes(const struct ritz *ritz, const double point[3], const double direction[3],
                 size_t first, size_t count, double *row);

/* Static compliance to a force of 1 along the inward normal at a point of the face whose outward
 * normal is `side` (-1, 1) times the axis `axis`, beyond that of a half-space, the load being
 * balanced by the inertia of the rigid motions (MESH: C without any mode taken off). NAN: out of
 * memory. */
double ritz_flexibility(const struct ritz *ritz, int axis, int side, const double point[3]);

/* What of it the polynomials do not resolve there, being coarser than the other faces are near:
 * from the opposite face, which is to be added, and an uncertainty of all. */
struct ritz_unresolved {
    double lacks, doubt;
};
struct ritz_unresolved ritz_unresolved_at(const struct ritz *ritz, int axis, const double point[3]);

#endif
