/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The waves of beam.h and torsion.h as families of modes. */
#ifndef PERCUSS_MODEL_BEAM_FAMILIES_H
#define PERCUSS_MODEL_BEAM_FAMILIES_H

#include "model/mode_family.h"

/* In the plane y as BAR_BENDING_Y, in the plane z as BAR_BENDING_Z; shapes are struct beam_mode. */
extern const struct mode_family beam_bending_family;

/* About the axis, by a load's moment. */
extern const struct mode_family beam_twist_family;

#endif
