/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A second way to the regular flexibility of a place on plane ground: Hertz's pressure of a radius
 * rho on the elements themselves. Its own weighted mean displacement, less that of the half-space,
 *
 *     c_hs = 3 (1 - nu^2) / (5 E rho),
 *
 * is the regular flexibility's mean over pairs of the pressure's points: that of the place but for
 * (rho / its distances to what is no half-space)^2. Nothing is split off, so elements must be as
 * small as a third of rho at least, and rho at most 0.4 of the distance to the edge. */
#ifndef PERCUSS_TEST_PATCH_H
#define PERCUSS_TEST_PATCH_H

#include "reduce/flexibility.h"

struct patch_answer {
    double flexibility; /* m/N, without rigid motion */
    double element;     /* longest edge of a face, mean over the load, m */
    double load;        /* N, before it is made to be 1: 1 but for quadrature */
};

/* By a Hertz pressure of `radius` about the place. Modes that the body removes stay in.
 * PERCUSS_INTERNAL without memory or convergence. */
enum percuss_status patch_press(const struct flexibility_body *body,
                                const struct flexibility_place *place, double radius,
                                struct patch_answer *answer, struct fault *fault);

/* The same mean by point forces in the place's neighbourhood: exact where the regular part is a
 * polynomial of fifth degree over the patch. */
enum percuss_status patch_of_points(const struct flexibility_body *body,
                                    struct flexibility *flexibility,
                                    const struct flexibility_place *place, double radius,
                                    double *mean, struct fault *fault);

#endif
