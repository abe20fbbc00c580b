/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies that fall from rest and rise, without air. */
#ifndef PERCUSS_MEASURED_FALL_H
#define PERCUSS_MEASURED_FALL_H

#include <math.h>

static const double FALL_STANDARD_GRAVITY = 9.80665; /* m/s^2, of no place in particular */

/* Speed after a fall from that height, or before a rise to it, m/s. */
static inline double fall_speed(double height, double gravity)
{
    return sqrt(2.0 * gravity * height);
}

#endif
