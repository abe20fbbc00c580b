/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The vibration of an elastic box or cylinder by Ritz's method in three dimensions:
 * displacements are sums of products of Legendre polynomials in x, y and z, which are orthonormal
 * in the box, so that the mass matrix is the identity and the stiffness matrix a sum of products of
 * integrals in closed form (Leissa and Zhang, J. Acoust. Soc. Am. 73 (1983) 2013). Displacements
 * even and odd about the three planes of symmetry do not mix: eight classes.
 *
 * A box may be held on its faces across x: the polynomials in x vanish there (Jacobi's, see
 * polynomial_held). With one face held there are four classes.
 *
 * Of a cylinder along x the polynomials in y and z are Zernike's, which are orthonormal in the
 * circle: harmonics of the angle times polynomials of the radius, with the same eight classes.
 *
 * A body has Young's modulus 1, density 1 and a longest side of 1; its origin is its centre. */
#ifndef PERCUSS_MODEL_RITZ_H
#define PERCUSS_MODEL_RITZ_H

#include <stdbool.h>
#include <stddef.h>

struct pace;
struct ritz;

/* Its shape: sides along x, y, z; a round one has its diameter twice. */
struct ritz_shape {
    double side[3];
    bool round;
    bool held[2]; /* a box: nothing moves on its faces at -x, +x */
};

/* The axis that stands for the side of a cylinder. */
enum { RITZ_ROUND = 3 };

/* Whether polynomials reach a shape: no thinner than 1/200 of its length. */
bool ritz_reaches(const struct ritz_shape *shape);

/* The vibration of these proportions. It takes milliseconds for a compact box and up to five
 * seconds for a thin plate or a long bar, and is immutable. The pace (NULL: it is never stopped) is
 * asked between the eight classes. NULL: out of memory, or stopped. */
struct ritz *ritz_create(const struct ritz_shape *shape, double poisson, struct pace *pace);
void ritz_free(struct ritz *ritz); /* NULL is allowed */

/* Its size without small members, bytes. */
size_t ritz_size(const struct ritz *ritz);

/* Elastic modes, ascending: as many as the polynomials resolve to some 1e-3. */
size_t ritz_mode_count(const struct ritz *ritz);
const double *ritz_omega(const struct ritz *ritz);

/* The frequency up to which it has modes; there may be none. */
double ritz_highest(const struct ritz *ritz);

/* Displacements along `direction` at a point of the modes first, ... first + count - 1, for unit
 * coordinates; each computed by itself. */
void ritz_shapes(const struct ritz *ritz, const double point[3], const double direction[3],
                 size_t first, size_t count, double *row);

/* Static compliance to a force of 1 along the inward normal at a point of the face with the outward
 * normal `side` (-1, 1) times the axis `axis`, beyond that of a half-space; the inertia of the
 * rigid motions balances the load unless a face is held. On a cylinder's side, RITZ_ROUND, it is
 * that of a contact of the radius RITZ_CUT, and changes by ritz_slope with the logarithm of the
 * radius. NAN: out of memory. */
double ritz_flexibility(const struct ritz *ritz, int axis, int side, const double point[3]);

/* The same for forces in all directions: a symmetric tensor xx yy zz xy yz zx in the body's frame
 * (the displacement of the point is tensor times force), beyond those of a half-space under a
 * normal and a tangential force. Of the normal's part it is ritz_flexibility. False: out of memory.
 */
bool ritz_tensor(const struct ritz *ritz, int axis, int side, const double point[3],
                 double tensor[6]);

static const double RITZ_CUT = 0.02; /* diameters */
double ritz_slope(const struct ritz *ritz);

/* The tensor of a place on a cylinder's side for a contact that is narrower than RITZ_CUT by a
 * logarithm of the radius, in the two directions along the side (cerruti3_add_slope, _contact). */
void ritz_tensor_narrow(const struct ritz *ritz, const double point[3], double logarithm,
                        double tensor[6]);

/* Errors of it where other faces are nearer than the polynomials resolve: the part due to the
 * opposite face, which is to be added, and the uncertainty due to all. */
struct ritz_unresolved {
    double lacks, doubt;
};
struct ritz_unresolved ritz_unresolved_at(const struct ritz *ritz, int axis, int side,
                                          const double point[3]);

#endif
