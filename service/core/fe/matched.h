/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Matched local compliance: Hertz's half-space holds compliance out to infinity, and a body's modes
 * with their residual flexibility hold its far field again. The compliance in series with the
 * contact law, by which both together are the real body's static compliance under the contact
 * patch, is
 *
 *     (body, balanced by its inertia) - (half-space) - (modes and residual flexibility),
 *
 * mostly negative. Displacements are relative to the body's mean: orthogonal to its rigid
 * motion. */
#ifndef PERCUSS_FE_MATCHED_H
#define PERCUSS_FE_MATCHED_H

#include <stdbool.h>

#include "model/body.h"

/* Compliance (m/N) of a body hit on its axis: a sphere, a flat-ended rod or cylinder in the middle
 * of an end face, a half-space (0). `patch` is the contact radius in m: a sphere's surface bends
 * away from the half-space's, which leaves a term in its logarithm; a flat end does not need it.
 * The basis held elsewhere is taken as rigid (sphere, cylinder) or as the free rod's L / (3 E A); a
 * rod with a fixed far end gets the same, since both differ far from the hit end alone. NAN: no
 * solution for such a solid (beam, block, rounded tip). False: out of memory. */
bool matched_compliance(const struct body *body, double patch, double *compliance);

/* The same in units of matched_unit(), 1/(young radius), 0 for a half-space: depends on the solid's
 * form and proportions, on Poisson's ratio and on `patch`, here over the solid's radius. */
double matched_unit(const struct body *body);
bool matched_share(const struct body *body, double patch, double *share);

/* In that unit: of a cylinder that is long or short, rigid basis. False:
 * out of memory. Some milliseconds; depends on poisson and on length / radius alone. */
bool matched_cylinder(double poisson, double slenderness, double *compliance);

/* In that unit: of a sphere; `patch` is the contact radius over the sphere's. */
double matched_sphere(double poisson, double patch);

#endif
