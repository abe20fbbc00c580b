/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A bar as percuss-reduce would make it of a mesh, ready to be hit at one place: modes of the mesh,
 * and the static flexibility at that place. It shares nothing with the theories of bars. */
#ifndef PERCUSS_TEST_ESTIMATES_MESHED_BAR_H
#define PERCUSS_TEST_ESTIMATES_MESHED_BAR_H

#include "physics/support.h"

struct meshed_bar {
    const struct body *bar; /* a beam, completed */
    double point[3];        /* on its side, in the beam's frame */
    double below;           /* rad/s: all modes below */
    size_t fine;            /* elements on the depth of the section */
};

/* Where `point` goes to: the middle of an element's face along the bar, and around a round one. */
void meshed_bar_snap(const struct body *bar, size_t fine, double point[3], double outward[3]);

/* For mesh_body_free. NULL, with the fault: it could not be made. */
struct mesh_body *meshed_bar_make(const struct meshed_bar *wanted, struct fault *fault);

#endif
