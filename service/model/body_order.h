/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A body of the catalogue that is given as a mesh, or whose file is not there, and what is heard of
 * it. */
#ifndef PERCUSS_MODEL_BODY_ORDER_H
#define PERCUSS_MODEL_BODY_ORDER_H

#include <stdbool.h>
#include <stddef.h>

#include "percuss/vocabulary.h"

enum { BODY_ORDER_SETS = 32, BODY_ORDER_ARGUMENTS = BODY_ORDER_SETS + 4, BODY_NEWS_SIZE = 480 };

/* What who asks for the body is told. */
struct body_news {
    enum percuss_status status; /* PERCUSS_BUSY: it is to come; else why it is not */
    char text[BODY_NEWS_SIZE];
};

struct body_board; /* where the news stand */

struct body_order {
    char id[PERCUSS_ID_SIZE];
    char name[65]; /* of the body's file: hash of all that it is made from */
    bool made;     /* that file is there: the set has the body itself */
    bool missing;  /* there is no mesh to reduce: the catalogue names a body's file, which lacks */
    char *mesh;    /* path of the mesh */
    char *arguments[BODY_ORDER_ARGUMENTS]; /* options of percuss-reduce, but for files */
    size_t argument_count;
    char material[400]; /* its material as a catalogue of its own; empty: the mesh states it */
    struct body_board *board;
};

/* Begins what is zeroed: the mesh waits. False: no memory. */
bool body_order_begin(struct body_order *order);

/* Any thread, as long as the order stands. */
void body_order_tell(const struct body_order *order, enum percuss_status status, const char *format,
                     ...) __attribute__((format(printf, 3, 4)));
struct body_news body_order_news(const struct body_order *order);

/* Frees what it holds and leaves it empty. */
void body_order_clear(struct body_order *order);

#endif
