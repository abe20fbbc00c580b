/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Refuses bodies and materials that cannot exist. Messages read "field: value: must be ...", the
 * field under its catalogue name, so that a loader can find its line. */
#ifndef PERCUSS_MODEL_BODY_CHECK_H
#define PERCUSS_MODEL_BODY_CHECK_H

#include "base/fault.h"
#include "model/body.h"

/* PERCUSS_OK, or PERCUSS_BAD_REQUEST with the message. */
enum percuss_status material_check(const struct material *material, struct fault *fault);

/* The same for what a catalogue states of a body, its material included. */
enum percuss_status body_check(const struct body *body, struct fault *fault);

#endif
