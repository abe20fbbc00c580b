/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A rod has longitudinal waves only. The part of a force across its axis bends it, which lowers the
 * restitution: by how much, from the modes of the beam that the rod is. */
#ifndef PERCUSS_SOLVE_ASKEW_H
#define PERCUSS_SOLVE_ASKEW_H

#include "solve/problem.h"
#include "solve/result.h"

/* By how much the restitution of a contact that lasts `duration` (s) is lower for the bending of
 * its rods; 0: neither body is a rod that is hit across its axis. */
double askew_loss(const struct problem *problem, size_t contact, double duration);

/* Says so where that is more than the tolerance. */
void askew_find(const struct problem *problem, size_t contact, double duration,
                struct warnings *warnings);

#endif
