/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How a contact lies on its two bodies, kept for places that were asked of before: a rig and an
 * ensemble ask of the same ones thousands of times, a co-simulation never of one twice. The key is
 * all that it follows from, to the last bit, so that a hit and a miss give the same bits; what is
 * asked for the first time is only marked, which costs next to nothing. */
#ifndef PERCUSS_SOLVE_PLACED_H
#define PERCUSS_SOLVE_PLACED_H

#include "contact/hertz.h"
#include "model/modal_basis.h"
#include "model/site.h"

/* Places that are kept: those of a scene, and of some scenes asked by turns. */
enum { PLACED_PLACES = 16 };

/* One side of a contact. */
struct contact_side {
    size_t body; /* index into the request's bodies */
    struct site site;
    struct material material; /* of the surface there */
    double direction[3];      /* of the force on the body per newton, body frame */
    struct site_load load;
};

/* What a contact's place follows from; a and b. */
struct placed_key {
    const struct body *bodies[2];
    const struct pose *poses[2];
    const double *point, *normal;
};

struct placed;
struct placed_store;

struct placed_store *placed_store_create(void); /* NULL: out of memory */
void placed_store_free(struct placed_store *store);

/* Fills both sides and the ellipse of a place that is kept, but for the indices of the bodies.
 * False: it is not; *room, where it is not NULL, is for placed_keep. Bodies of meshes are not kept,
 * whose sites lie in the catalogue. */
bool placed_find(struct placed_store *store, const struct placed_key *key,
                 struct contact_side sides[2], struct hertz_contact *hertz, struct placed **room);
void placed_keep(struct placed *room, const struct placed_key *key,
                 const struct contact_side sides[2], const struct hertz_contact *hertz);

#endif
