/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How accurate time steps are to begin with. */
#ifndef PERCUSS_SOLVE_FIRST_STEPS_H
#define PERCUSS_SOLVE_FIRST_STEPS_H

#include <stdbool.h>

/* A tolerance that asks for the audit to close. */
static const double FIRST_STEPS_AUDITED = 1e-8;
/* From here down longer steps are tried for comparison, for sequences always. */
static const double FIRST_STEPS_COMPARED = 1e-5;
/* Tolerances from which on first order along the answer says what a sequence's error is
 * (sequence.h): with the usual steps, and with finer ones, which cost less than another solution.
 */
static const double FIRST_STEPS_FOLLOWED = 6e-4;
static const double FIRST_STEPS_FOLLOWED_FINE = 1e-4;

/* Accuracy of the time steps to begin with; a sequence of sub-impacts is expected to amplify their
 * error. */
double first_steps_accuracy(double tolerance, bool sequence, bool group);

#endif
