/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Steps that pass knots of an interpolated law. A force's third derivative jumps there: of its
 * moments four nodes miss what goes with the fourth power of the step, where they miss the eighth
 * of a smooth one. The indentation, on which the force acts by its double integral, stays smooth
 * enough: it tells how the jumps go on, and that has moments. */
#ifndef PERCUSS_IMPACT_STEP_KNOTS_H
#define PERCUSS_IMPACT_STEP_KNOTS_H

#include "impact/contact_step.h"

/* After a step of a scene of one contact was solved, which began with an indentation `start`: where
 * it passes knots, the forces at its nodes become those of the cubic with the moments, up to the
 * third, of the law's force, and the indentations at nodes and end those under them. False: it
 * passes none, or is not closed throughout; all stays as it is. */
bool step_knots_pass(struct contact_step *step, const struct scene *scene, int level, double start);

#endif
