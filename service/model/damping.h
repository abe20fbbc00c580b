/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Damping of a body's modes: one ratio for all, or of a mesh one of each. Those are kept as shares
 * of the largest, so that who varies a body's damping scales all of them: of the modes from the
 * lowest up, the last one of all others. */
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
