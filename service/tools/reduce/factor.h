/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Factors L D L^T of K + shift M by MUMPS, sequential: solutions of many right-hand sides, and the
 * number of negative eigenvalues. */
#ifndef PERCUSS_REDUCE_FACTOR_H
#define PERCUSS_REDUCE_FACTOR_H

#include "mesh/matrices.h"

struct factor;

/* Positive definite takes no pivots and is the faster; one that is not is refused then. */
enum factor_kind { FACTOR_POSITIVE, FACTOR_INDEFINITE };

/* Before anything is factored. */
struct factor_cost {
    double memory;     /* bytes while it is factored */
    double operations; /* floating-point */
    double entries;    /* of L */
};

/* Orders the unknowns, or takes the order of `like`, of the same matrices (NULL: there is none);
 * `matrices` are borrowed until factor_free. PERCUSS_BAD_REQUEST: too many unknowns;
 * PERCUSS_INTERNAL without memory or with MUMPS's own code. */
enum percuss_status factor_analyse(const struct matrices *matrices, enum factor_kind kind,
                                   const struct factor *like, struct factor **factor,
                                   struct fault *fault);

struct factor_cost factor_cost(const struct factor *factor);

/* Factors K + shift M (1/s^2), in place of the previous factor. PERCUSS_BAD_REQUEST: singular,
 * or not positive definite where it must be. */
enum percuss_status factor_compute(struct factor *factor, double shift, struct fault *fault);

/* Solves in place for `count` right-hand sides, one after the other. Values at held degrees of
 * freedom are taken for zero. */
enum percuss_status factor_solve(struct factor *factor, size_t count, double *b,
                                 struct fault *fault);

/* Whether forked copies of the process may solve too, each by itself. */
bool factor_forks(void);

/* Eigenvalues below zero of the factored matrix: by Sylvester's law of inertia the eigenvalues of K
 * x = w^2 M x below -shift. */
size_t factor_negatives(const struct factor *factor);

/* NULL is allowed. */
void factor_free(struct factor *factor);

#endif
