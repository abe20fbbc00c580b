/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A body of the catalogue whose mesh is still to be reduced. */
#ifndef PERCUSS_MODEL_BODY_ORDER_H
#define PERCUSS_MODEL_BODY_ORDER_H

#include <stddef.h>

#include "percuss/vocabulary.h"

enum { BODY_ORDER_SETS = 32, BODY_ORDER_ARGUMENTS = BODY_ORDER_SETS + 4 };

struct body_order {
    char id[PERCUSS_ID_SIZE];
    char name[65]; /* of the body's file: hash of all that it is made from */
    char *mesh;    /* path of the mesh */
    char *arguments[BODY_ORDER_ARGUMENTS]; /* options of percuss-reduce, but for files */
    size_t argument_count;
    char material[400]; /* its material as a catalogue of its own; empty: the mesh states it */
    char reason[400];   /* why it could not be reduced; empty: it is yet to be */
};

/* Frees what it holds and leaves it empty. */
void body_order_clear(struct body_order *order);

#endif
