/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What ritz.c, which makes the modes, and ritz_flexibility.c share of a vibration. */
#ifndef PERCUSS_MODEL_RITZ_PARTS_H
#define PERCUSS_MODEL_RITZ_PARTS_H

#include <stdbool.h>
#include <stddef.h>

#include "model/polynomial.h"

/* The most of a class, for which those along the longer sides are taken off in proportion. */
enum { RITZ_CLASSES = 8, RITZ_MOST_OF_CLASS = 1400, RITZ_MOST_ORDERS = 66 };

/* One class: components, then their polynomials. */
struct ritz_class {
    size_t count;              /* of coordinates */
    size_t begin[4];           /* of each component's, and the end */
    unsigned char (*order)[3]; /* [count] */
    double *factor;            /* Cholesky's of the stiffness matrix with the rigid motions held */
    size_t rigids;             /* rigid motions of the class */
    double *rigid[3];          /* [count], orthonormal */
    size_t modes;
    double *omega, *vectors; /* [modes], [modes][count] */
};

struct ritz {
    double poisson;
    bool round;
    bool held[2];
    double side[3], mass;
    size_t orders[3];  /* polynomials along each side; of x, where it is held, those that vanish */
    size_t lifted;     /* so many of them are lower than those of the held box beside it */
    bool mixed;        /* classes of that box hold both parities of x */
    struct ritz *free; /* of a held box: factors of the same polynomials with those that do not
                        * vanish on its held faces */
    double *line[2];   /* of a held box: means along x, until the classes are solved */
    size_t *place, places; /* of Zernike's polynomials, [q][r] */
    double *means[5];      /* of a circle, until the classes are solved */
    struct ritz_class class[RITZ_CLASSES];
    double highest; /* frequency up to which there are modes */
    size_t count;
    double *omega; /* [count] */
    struct ritz_mode {
        unsigned char class;
        unsigned number;
    } * mode; /* [count] */
};

/* The component of a class' coordinate. */
int ritz_component(const struct ritz_class *class, size_t i);

/* All polynomials at a point: along the axes, and those of a circle. */
struct ritz_functions {
    double along[3][RITZ_MOST_ORDERS];
    double section[POLYNOMIAL_MOST * POLYNOMIAL_MOST];
};
void ritz_functions_fill(const struct ritz *ritz, const double point[3], struct ritz_functions *at);

/* A class' coordinates there, along a direction: [count]. */
void ritz_functions_of_class(const struct ritz *ritz, const struct ritz_class *class,
                             const struct ritz_functions *at, const double direction[3],
                             double *functions);

#endif
