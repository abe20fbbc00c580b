/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the supports of a deck, its *BOUNDARY, hold: told only, as --fixed holds a body here. */
#ifndef PERCUSS_MESH_DECK_SUPPORT_H
#define PERCUSS_MESH_DECK_SUPPORT_H

#include "mesh/deck.h"

/* Bits 0 to 2 of the displacements that a line of *BOUNDARY holds: from direction `first` to `last`
 * ("" or NULL: that one alone), or by the name of a support (PINNED; all three of one that is not
 * known). 0: rotations, temperatures. */
unsigned deck_support_directions(const char *first, const char *last);

/* Adds directions to those in which a set is held; "": single nodes. False: out of memory. */
bool deck_support_add(struct deck *deck, const char *set, unsigned directions);

/* Tells of each set, what holds it here, and what --fixed cannot. */
bool deck_support_tell(struct deck *deck);

#endif
