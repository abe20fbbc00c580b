/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of a vibration by Ritz's method: ritz.c computes them, ritz_flexibility.c uses them.
 */
#ifndef PERCUSS_MODEL_RITZ_PARTS_H
#define PERCUSS_MODEL_RITZ_PARTS_H

#include "model/ritz_basis.h"

/* One class: its products, stiffness and modes. */
struct ritz_class {
    struct ritz_terms terms;
    double *factor;   /* Cholesky's of the stiffness matrix with the rigid motions held */
    size_t rigids;    /* rigid motions of the class */
    double *rigid[3]; /* [count], orthonormal */
    size_t modes;
    double *omega, *vectors; /* [modes], [modes][count] */
};

struct ritz {
    struct ritz_basis basis; /* of density 1: its volume is the mass */
    double poisson;
    struct ritz *free; /* of a held box: factors of the same polynomials with those that do not
                        * vanish on its held faces */
    struct ritz_class class[RITZ_CLASSES];
    double highest; /* frequency up to which there are modes */
    size_t count;
    double *omega; /* [count] */
    struct ritz_mode {
        unsigned char class;
        unsigned number;
    } * mode; /* [count] */
};

#endif
