/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where the bodies of a problem are, how their contacts lie on them, and how those close. */
#ifndef PERCUSS_SOLVE_PLACEMENT_H
#define PERCUSS_SOLVE_PLACEMENT_H

#include "solve/problem.h"

/* Fills all of an empty problem but the laws and the compliance. PERCUSS_OK, or the refusal with
 * its message: UNKNOWN_BODY, BAD_REQUEST, UNSUPPORTED_GEOMETRY, NOT_APPROACHING. */
enum percuss_status placement_find(struct problem *problem, const struct body_set *catalogue,
                                   struct fault *fault);

/* The part that velocities decide, where the request has other ones than when it was placed. OK,
 * NOT_APPROACHING or BAD_REQUEST. */
enum percuss_status placement_find_rates(struct problem *problem, struct fault *fault);

#endif
