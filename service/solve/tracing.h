/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The time histories of an answer, for requests that ask for them. */
#ifndef PERCUSS_SOLVE_TRACING_H
#define PERCUSS_SOLVE_TRACING_H

#include "solve/result.h"
#include "solve/solution.h"

/* Solves the answer's scene once more by the modal method, with the forces taken down, and sets
 * result->trace. That may take as much work as an answer, and the histories as much again: where it
 * is spent they end, with a warning. Warns where the answer came from another method and that
 * solution differs. Returns result->status, or INTERNAL or TIMEOUT with the message. */
enum percuss_status tracing_make(const struct problem *problem, const struct solution *solution,
                                 struct pace *pace, struct solve_result *result);

#endif
