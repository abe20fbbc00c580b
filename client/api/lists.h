/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A catalogue as percuss_bodies hands it out, from the bodies that a server announces. */
#ifndef PERCUSS_API_LISTS_H
#define PERCUSS_API_LISTS_H

#include <percuss/percuss.h>

#include "percuss_wire.h"

/* An empty list with room for `most` bodies. False: no memory, for lists_end_bodies. */
bool lists_begin_bodies(struct percuss_body_list *list, size_t most);

/* Adds a copy of a body, and the pairs of its materials that are not there yet. The same. */
bool lists_add_body(struct percuss_body_list *list, const percuss_v1_Body *wire);

/* Sorts a whole list. NO_MEMORY, with its text, and an empty list where one of the others failed.
 */
enum percuss_result lists_end_bodies(struct percuss_body_list *list, bool whole);

#endif
