/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Materials that relax (model/relaxation.h), as an impact finds them: stiff as they are at its
 * frequency. */
#ifndef PERCUSS_SOLVE_RELAXED_H
#define PERCUSS_SOLVE_RELAXED_H

#include "solve/problem.h"

/* Whether the material of a body of the problem relaxes. */
bool relaxed_any(const struct problem *problem);

/* Replaces each body of such a material by one with the storage modulus as `young`, and the loss
 * factor, of the frequency of its fastest contact (of the problem's, where none of its own
 * approaches). That is pi over the duration of an elastic contact of the rigid masses with these
 * moduli. The problem's contacts are placed and have their rates; they are to be placed anew. The
 * series itself stays the body's, for contact laws and for the damping of modes. PERCUSS_OK,
 * BAD_REQUEST (a modulus that no body may have), INTERNAL. */
enum percuss_status relaxed_bodies(struct problem *problem, struct fault *fault);

#endif
