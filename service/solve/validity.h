/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where the models end: warnings, and what they leave out by nature. */
#ifndef PERCUSS_SOLVE_VALIDITY_H
#define PERCUSS_SOLVE_VALIDITY_H

#include "solve/geometry.h"

/* Estimated effect on the restitution of waves in bodies that are rigid by their shape (the
 * half-space: Hunter 1957; spheres and compact bodies: Rayleigh 1906). */
double validity_wave_loss(const struct geometry *geometry, const struct solve_request *request,
                          const struct solve_result *result);

/* Adds the warnings: yield, size of the contact, speed, edges, differing delassus, compliance. */
void validity_warn(const struct geometry *geometry, const struct solve_request *request,
                   struct solve_result *result);

#endif
