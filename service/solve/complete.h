/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Requests answered by complete finite elements (fe/impact_complete.h): one central impact of two
 * bodies at rest but for their approach. */
#ifndef PERCUSS_SOLVE_COMPLETE_H
#define PERCUSS_SOLVE_COMPLETE_H

#include "base/watch.h"
#include "solve/problem.h"
#include "solve/result.h"

/* Solves on meshes of 4, 8 and 16 elements across the contact radius, with three or six places of
 * the nodes each, until the estimated error of the restitution fits the tolerance
 * (fe/complete_converge.h); answers with the mean of the finest mesh's phases. `pace` is told the
 * part done, and stops it with TIMEOUT. Fills `result`, status and message too, and returns the
 * status: BAD_REQUEST and UNSUPPORTED_GEOMETRY name what is not axisymmetric. */
enum percuss_status complete_answer(const struct problem *problem, struct pace *pace,
                                    struct solve_result *result);

#endif
