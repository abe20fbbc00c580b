/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A catalogue as percuss_bodies hands it out, from the bodies that a server announces. */
#ifndef PERCUSS_API_LISTS_H
#define PERCUSS_API_LISTS_H

#include <percuss/percuss.h>

#include "percuss_wire.h"

/* A list under way. */
struct lists_bodies {
    struct percuss_body_list list;
    size_t pair_room;
    bool failed; /* no memory */
    bool mixed;  /* bodies of several catalogues: a reload is under way */
};

/* An empty list with room for `most` bodies. */
struct lists_bodies lists_begin_bodies(size_t most);

/* Adds a copy of a body and of the pairs of its materials, which may be there already. */
void lists_add_body(struct lists_bodies *made, const percuss_v1_Body *wire);

/* The list, sorted, with each pair once. NO_MEMORY, with its text, and an empty list where there
 * was too little. */
enum percuss_result lists_end_bodies(struct lists_bodies *made, struct percuss_body_list *list);

#endif
