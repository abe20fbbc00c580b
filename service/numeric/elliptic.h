/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Carlson's symmetric elliptic integrals, which have no cancellation near the circle. */
#ifndef PERCUSS_NUMERIC_ELLIPTIC_H
#define PERCUSS_NUMERIC_ELLIPTIC_H

/* R_F(0, y, z) for y, z > 0: K(m) = R_F(0, 1 - m, 1). */
double elliptic_rf0(double y, double z);

/* R_D(0, y, z) for y, z > 0: (K(m) - E(m)) / m = R_D(0, 1 - m, 1) / 3. */
double elliptic_rd0(double y, double z);

#endif
