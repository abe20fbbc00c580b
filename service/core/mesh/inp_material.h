/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a *MATERIAL of a deck states, keyword by keyword and row by row. A value that is none is
 * refused only if the body is of the material: it is kept in deck_material.refused. */
#ifndef PERCUSS_MESH_INP_MATERIAL_H
#define PERCUSS_MESH_INP_MATERIAL_H

#include "mesh/card.h"
#include "mesh/deck.h"

/* State of reading. */
struct inp_material {
    struct deck *deck;
    size_t at;                   /* of deck.materials; DECK_NONE: before the first one */
    enum deck_property property; /* of the rows */
    double temperature;          /* of the first row */
    int row, taken;              /* rows so far; those taken */
};

/* *ELASTIC, *DENSITY, *PLASTIC, each once in a material; *rows: inp_material_row is to read the
 * lines of data. PERCUSS_BAD_REQUEST: before the first material; PERCUSS_INTERNAL without memory.
 */
enum percuss_status inp_material_property(struct inp_material *material, const struct scan *scan,
                                          const struct card *card, bool *rows);

enum percuss_status inp_material_row(struct inp_material *material, struct scan *scan, char *line);

/* Another law: left out beside *ELASTIC, refused in its place. */
enum percuss_status inp_material_law(struct inp_material *material, const struct scan *scan,
                                     const struct card *card);

#endif
