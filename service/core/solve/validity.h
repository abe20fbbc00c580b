/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where the models end: warnings, and effects that they lack by nature. */
#ifndef PERCUSS_SOLVE_VALIDITY_H
#define PERCUSS_SOLVE_VALIDITY_H

#include "impact/impact.h"
#include "solve/problem.h"
#include "solve/result.h"

/* Estimated effect on the restitution of waves in spheres and compact bodies, which are rigid by
 * their shape (Rayleigh 1906). */
double validity_wave_loss(const struct problem *problem);

/* Looks where a solution leaves the models' range: yield, size of contact and dent, edges, speed,
 * a missing table, the end of one, sliding without friction, with friction turning contacts and
 * Painleve, a differing delassus, compliance, losses of the materials themselves, no touch. Written
 * into `warnings` from its beginning. */
void validity_find(const struct problem *problem, const struct impact_outcome *outcome,
                   struct warnings *warnings);

/* The part that needs no solution: adds the speeds of approach. */
void validity_find_speed(const struct problem *problem, struct warnings *warnings);

/* Adds the waves left out, where they matter: of compact bodies, and of half-spaces, which change
 * the restitution by `radiated` (struct assembly). */
void validity_find_waves(const struct problem *problem, double radiated, struct warnings *warnings);

#endif
