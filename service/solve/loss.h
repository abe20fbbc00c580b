/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What materials lose of themselves in a contact, which no contact law has: polymers, rubber, wood.
 * (Their vibration is damped, see the key `damping`.)
 *
 * A material of loss factor eta loses 2 pi eta of the energy that it stores at most in a cycle of
 * strain, and pi eta in the half of one that a contact is. What comes back of a rebound's energy is
 * exp(-pi eta), the resilience of rubber (Gent, Engineering with Rubber, chapter 4), and of the
 * restitution exp(-pi eta/2). Of two bodies each stores its share of the indentation:
 * (1 - nu^2)/E, of the sum of both. Hertz's contact with a viscosity that gives eta at the
 * frequency of its duration T, pi/T, loses 1.77 eta instead of 1.57 (Kuwabara and Kono, Jpn. J.
 * Appl. Phys. 26 (1987) 1230). */
#ifndef PERCUSS_SOLVE_LOSS_H
#define PERCUSS_SOLVE_LOSS_H

#include "impact/impact.h"
#include "solve/problem.h"
#include "solve/warnings.h"

/* By how much the restitution of a contact is lower for what its materials state (loss_factor);
 * `rebound` is the restitution that what follows the largest indentations makes. */
double loss_of_contact(const struct problem *problem, size_t contact, double rebound);

/* The largest of all contacts. */
double loss_worst(const struct problem *problem, const struct impact_outcome *outcome);

/* Adds what is more than the tolerance: stated, or certain of a material as soft as that. */
void loss_find(const struct problem *problem, size_t contact, double rebound,
               struct warnings *warnings);

#endif
