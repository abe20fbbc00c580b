/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A basis that may be turned: where two families of a body are alike (a round or square section
 * bends alike in all planes), the modes are taken in the plane that a load excites, so that a roll
 * of the body about its axis changes nothing, and one family does for both. */
#ifndef PERCUSS_MODEL_ROLL_H
#define PERCUSS_MODEL_ROLL_H

#include "model/modal_basis.h"

/* The families `first` and first + 1, say y and z, in new planes: cosine y - sine z and
 * cosine z + sine y. */
struct roll {
    size_t first;
    double cosine, sine; /* sine 0: as they are */
};

/* The first of two families that are alike, if this is one of them; the family itself otherwise. */
size_t roll_common_family(const struct body *body, size_t family);

/* Whether the load excites families that may be turned; *roll: such that it excites the second of
 * them alone. Planes closer to the body's own than 1e-9 rad are those: rounding of the pose. */
bool roll_choose(const struct body *body, const struct site_load *load, struct roll *roll);

/* Turns a load into the planes of a roll. */
void roll_load(const struct body *body, const struct roll *roll, struct site_load *load);

/* Turns `count` modal coordinates of both families, in place. */
void roll_coordinates(const struct roll *roll, size_t count, double *y, double *z);

#endif
