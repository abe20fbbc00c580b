/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The factor of K + s M for a complex s, made once and used for every step (MUMPS, sequential). */
#ifndef PERCUSS_SPATIAL_KEPT_FACTOR_H
#define PERCUSS_SPATIAL_KEPT_FACTOR_H

#include <complex.h>

#include "spatial/system.h"

struct kept_factor;

/* OK, or INTERNAL with the error code of MUMPS. */
enum percuss_status kept_factor_create(const struct system3 *system, double complex s,
                                       struct kept_factor **factor, struct fault *fault);
void kept_factor_free(struct kept_factor *factor);

/* Solves (K + s M) x = right in place for `count` vectors, one after the other. False: it failed.
 */
bool kept_factor_solve(struct kept_factor *factor, size_t count, double complex *right);

/* Numbers in the factor. */
double kept_factor_size(const struct kept_factor *factor);

#endif
