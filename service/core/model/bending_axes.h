/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Principal bending axes: where two families of a body are alike (a round or square section bends
 * alike in all planes), the modes are taken in the plane that a load excites, so that a rotation of
 * the body about its axis changes nothing, and one family does for both. */
#ifndef PERCUSS_MODEL_BENDING_AXES_H
#define PERCUSS_MODEL_BENDING_AXES_H

#include "model/modal_basis.h"

/* The families `first` and first + 1, say y and z, in new planes: cosine y - sine z and
 * cosine z + sine y. */
struct bending_axes {
    size_t first;
    double cosine, sine; /* sine 0: not turned */
};

/* The first of two families that are alike, if this is one of them; the family itself otherwise. */
size_t bending_axes_common_family(const struct body *body, size_t family);

/* Whether the load excites families that may be turned; *axes: such that it excites the second
 * family alone. Planes closer to the body's own than 1e-9 rad are taken as these: rounding of the
 * pose. */
bool bending_axes_choose(const struct body *body, const struct site_load *load,
                         struct bending_axes *axes);

/* Turns a load into the planes of the axes. */
void bending_axes_turn_load(const struct body *body, const struct bending_axes *axes,
                            struct site_load *load);

/* Turns `count` modal coordinates of both families, in place. */
void bending_axes_turn(const struct bending_axes *axes, size_t count, double *y, double *z);

#endif
