/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Block Lanczos for K x = w^2 M x by (K + s M)^-1 M: its largest eigenvalues 1/(w^2 + s) are the
 * lowest modes (Grimes, Lewis & Simon 1994, SIAM J. Matrix Anal. 15, 228), with full
 * reorthogonalisation in the inner product of M. */
#ifndef PERCUSS_REDUCE_LANCZOS_H
#define PERCUSS_REDUCE_LANCZOS_H

#include "base/watch.h"
#include "numeric/dense.h"
#include "reduce/factor.h"

/* A block as wide as no frequency is multiple in practice, so that none loses a copy. */
enum { LANCZOS_BLOCK = 8 };

/* |A x - t x| over t in the norm of M, t = 1/(w^2 + s): the frequency's relative error is about its
 * square, that of the shape this over the relative gap to the next. */
static const double LANCZOS_RESIDUAL = 1e-8;

struct lanczos_input {
    const struct matrices *matrices;
    struct factor *factor; /* of K + shift M */
    double shift;          /* 1/s^2 */
    struct dense rigid;    /* M-orthonormal: kept out */
    size_t count;          /* modes that are wanted */
    uint64_t seed;         /* of the first vectors */
    const struct watch *watch;
    /* Told once, when three quarters of the modes have converged, the frequencies of all that are
     * wanted (rad/s, ascending), which are good to 1e-4 then; NULL: not wanted. */
    void (*foreseen)(void *context, const double *omega);
    void *foreseen_context;
};

/* Fills `omega` [count], ascending, and `shapes` [count][n], M-orthonormal; both the caller's to
 * free. PERCUSS_TIMEOUT: the watch stopped it; PERCUSS_BAD_REQUEST: the mesh has fewer modes;
 * PERCUSS_INTERNAL without memory. Elsewhere NULL. */
enum percuss_status lanczos_modes(const struct lanczos_input *input, double **omega,
                                  double **shapes, struct fault *fault);

/* Vectors that so many modes take, for estimates of time and memory: of compact bodies a tenth
 * more, of slender ones, whose frequencies lie farther apart, half as many. */
size_t lanczos_expected_vectors(size_t count);

#endif
