/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Longitudinal waves of a straight uniform bar, as a family of modes: omega_k = k pi c/L
 * (free-free), (k - 1/2) pi c/L (one end held), with Rayleigh-Love omega/sqrt(1 + (nu k r_p)^2).
 * They are driven by forces along x on the ends. */
#ifndef PERCUSS_MODEL_LONGITUDINAL_H
#define PERCUSS_MODEL_LONGITUDINAL_H

#include "model/mode_family.h"

extern const struct mode_family longitudinal_family;

#endif
