/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Where the rings of a mesh lie: positions along the contact surface and rows along a rod. */
#ifndef PERCUSS_FE_MESH_RINGS_H
#define PERCUSS_FE_MESH_RINGS_H

#include <stddef.h>

struct mesh_grade {
    double size;    /* m, elements of the core */
    size_t core;    /* elements along a side of the core, 2 ... 200 */
    double growth;  /* of the rings' widths, 1 ... 2 */
    double matched; /* m, contact nodes up to here are the same in every body of this grade */
    double coarse;  /* m, longest element wanted beyond a rod's end region; 0: as in the region */
};

enum { MESH_RINGS_MAX = 20000 };

/* Positions of the rings along a surface that ends at `end`, from the core's rim (position 0 of the
 * list) to the end; the arc that belongs to a radius is radius (flat) or sphere * asin(radius /
 * sphere); `sphere` is INFINITY on a flat. Exact geometric steps in radius as far as
 * grade->matched, then a ratio that fits. Returns their number less one (the rings), 0 where the
 * grade does not fit. The caller frees *positions. */
size_t mesh_rings(const struct mesh_grade *grade, double sphere, double end, double **positions);

/* Heights of rows that fill `length`, from `first` growing to at most `coarse`. Returns their
 * number, 0 where there would be too many. The caller frees *heights. */
size_t mesh_rows(double length, double first, const struct mesh_grade *grade, double **heights);

#endif
