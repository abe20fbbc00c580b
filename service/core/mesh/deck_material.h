/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Materials of decks in SI. */
#ifndef PERCUSS_MESH_DECK_MATERIAL_H
#define PERCUSS_MESH_DECK_MATERIAL_H

#include "mesh/deck.h"

/* Gives a part the material of its section; what the deck does not state stays NAN, and part->lacks
 * names the card. Tells of decks in inches, which may be in pounds-force. PERCUSS_BAD_REQUEST:
 * values outside those of solids, or another law. */
enum percuss_status deck_material_give(struct deck *deck, const struct deck_material *from,
                                       double unit, struct mesh_part *part, struct fault *fault);

#endif
