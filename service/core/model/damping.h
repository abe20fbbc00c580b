/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Damping of a body's modes: one ratio for all, or for a mesh a list from the lowest mode up, the
 * last ratio for all further modes. A list is stored as shares of its largest ratio, so that a
 * variation of the damping scales all of them. */
#ifndef PERCUSS_MODEL_DAMPING_H
#define PERCUSS_MODEL_DAMPING_H

#include "model/body.h"
#include "model/body_kind.h"

/* The ratio of a mode. */
double damping_of(const struct body *body, size_t mode);

/* The largest of the modes from `first` on. */
double damping_from(const struct body *body, size_t first);

/* In words; nothing where there is none. */
void damping_describe(const struct body *body, struct body_description *description);

#endif
