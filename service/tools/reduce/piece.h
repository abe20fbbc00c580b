/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Parts of an element that are split while they are near a place whose field is steep. */
#ifndef PERCUSS_REDUCE_PIECE_H
#define PERCUSS_REDUCE_PIECE_H

#include "mesh/element.h"

/* A part of an element in natural coordinates: a tetrahedron by its corners, a box by two, a wedge
 * by those of its lower triangle and the one above the first. */
struct piece {
    double corners[4][3];
};

/* All of an element of each type. */
extern const struct piece WHOLE_PIECE[ELEMENT_TYPES];

/* A point of the piece: of a tetrahedron with volume coordinates 1 - a - b - c, a, b, c; of a box
 * from the first corner to the second as the natural coordinates go from -1 to 1; of a wedge with
 * both. */
void piece_point(enum element_type type, const struct piece *piece, const double at[3],
                 double natural[3]);

/* Eight pieces of an eighth of the volume. */
void piece_split(enum element_type type, const struct piece *piece, struct piece parts[8]);

#endif
