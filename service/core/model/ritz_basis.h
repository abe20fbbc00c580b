/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The basis of Ritz's method in a box or a cylinder (ritz.h): orthogonal polynomials on a line and
 * in a circle, their products, and the stiffness matrix of these. */
#ifndef PERCUSS_MODEL_RITZ_BASIS_H
#define PERCUSS_MODEL_RITZ_BASIS_H

#include <stdbool.h>
#include <stddef.h>

/* Largest number of polynomials of a circle along y or z. */
enum { POLYNOMIAL_MOST = 40 };

/* Legendre's, of mean square 1 over [-1, 1]. */
void polynomial_legendre(size_t count, double x, double *value);

/* Those that vanish at x = -1 (held[0]), at x = 1 (held[1]) or at both, of mean square 1 and
 * orthogonal over [-1, 1]: (1 - x)^a (1 + x)^b P_n, a and b being 1 where it is held and 0
 * elsewhere, P_n Jacobi's of (2 a, 2 b). With their derivatives unless that is NULL. */
void polynomial_held(size_t count, const bool held[2], double x, double *value, double *slope);

/* Zernike's of mean square 1 over the circle of radius 1, in the place of y^q z^r, q + r < count:
 * sqrt((2) (n + 1)) R_n^m(radius) cos(m angle) or sin, n = q + r; cosines where r is even, with
 * the parities of y^q z^r. R_n^m(s) = s^m P_k(2 s^2 - 1), P_k Jacobi's of (0, m), k = (n -
 * m)/2. With derivatives along y and z where these are not NULL; [q][r], POLYNOMIAL_MOST long. */
void polynomial_zernike(size_t count, double y, double z, double *value, double *along_y,
                        double *along_z);

/* Gauss' rule of n points on [0, 1], by Newton's method on Legendre's polynomial. */
void polynomial_gauss(size_t n, double *x, double *weight);

/* Most products of a class, for which those along the longer sides are taken off in proportion. */
enum { RITZ_CLASSES = 8, RITZ_MOST_OF_CLASS = 1400, RITZ_MOST_ORDERS = 66 };

struct ritz_basis {
    bool round;
    bool held[2];
    double side[3], volume;
    size_t orders[3]; /* polynomials along each side; of x, where it is held, those that vanish */
    size_t lifted;    /* free box of a held one: its additional polynomials in x */
    bool mixed;       /* classes of the held box have both parities of x */
    double *line[2];  /* of a held box: means along x, until they are dropped */
    size_t *place, places; /* of Zernike's polynomials, [q][r] */
    double *means[5];      /* of a circle, until they are dropped */
};

/* The products of one class: of each component of the displacement in turn. */
struct ritz_terms {
    size_t count;
    size_t begin[4];           /* of each component's, and the end */
    unsigned char (*order)[3]; /* [count] */
};

/* Number of held faces; the axis of the shortest side. */
size_t ritz_basis_holds(const struct ritz_basis *basis);
int ritz_basis_thinnest(const struct ritz_basis *basis);

/* Sets the orders of a basis that has its shape. */
void ritz_basis_choose_orders(struct ritz_basis *basis);

/* Computes the means that the stiffness matrix needs. False: out of memory. */
bool ritz_basis_prepare(struct ritz_basis *basis);
void ritz_basis_drop_means(struct ritz_basis *basis);
void ritz_basis_clear(struct ritz_basis *basis);

/* Writes the products of class `number` into zeroed terms; the caller frees their `order`. False:
 * out of memory. */
bool ritz_basis_list(const struct ritz_basis *basis, int number, struct ritz_terms *terms);

/* The component of a product. */
static inline int ritz_component(const struct ritz_terms *terms, size_t i)
{
    return i < terms->begin[1] ? 0 : i < terms->begin[2] ? 1 : 2;
}

/* Stiffness matrix of modulus 1: the lower triangle, by columns. */
void ritz_basis_stiffness(const struct ritz_basis *basis, const struct ritz_terms *terms,
                          double poisson, double *k);

/* All polynomials at a point: along the axes, and those of a circle. */
struct ritz_functions {
    double along[3][RITZ_MOST_ORDERS];
    double section[POLYNOMIAL_MOST * POLYNOMIAL_MOST];
};
void ritz_functions_fill(const struct ritz_basis *basis, const double point[3],
                         struct ritz_functions *at);

/* A class' products there, along a direction: [count]. */
void ritz_functions_along(const struct ritz_basis *basis, const struct ritz_terms *terms,
                          const struct ritz_functions *at, const double direction[3],
                          double *functions);

#endif
