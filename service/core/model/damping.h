/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Damping of a body's modes: one ratio for all; for a mesh a list from the lowest mode up, the last
 * ratio for all further modes; or of a material that relaxes half of its loss factor at each mode's
 * frequency. body->damping is the largest ratio, and the others are shares of it, so that a
 * variation of the damping scales all of them. */
#ifndef PERCUSS_MODEL_DAMPING_H
#define PERCUSS_MODEL_DAMPING_H

#include "model/body.h"
#include "model/body_kind.h"

/* The ratio of a mode with the frequency `omega` (rad/s). */
double damping_of(const struct body *body, size_t mode, double omega);

/* The largest of the modes from `first` on, the lowest of which has the frequency `omega`; of a
 * material that relaxes to 1 %. */
double damping_from(const struct body *body, size_t first, double omega);

/* In words; nothing where there is none. */
void damping_describe(const struct body *body, struct body_description *description);

#endif
