/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A beam whose section is alike in all directions may bend in any plane: the scene takes the one
 * that its contacts excite, so that a roll of the beam about its axis changes nothing. */
#ifndef PERCUSS_SOLVE_ROLL_H
#define PERCUSS_SOLVE_ROLL_H

#include "base/arena.h"
#include "solve/request.h"

struct geometry;

/* Planes of bending turned about the body's axis: the scene's deflections are cosine y - sine z and
 * cosine z + sine y. */
struct roll {
    double cosine, sine;
};

/* Chooses the planes of every body after its contacts are placed: the loads are turned into them,
 * and so are the states (geometry->rolls, geometry->states). False: out of memory. */
bool roll_choose(struct geometry *geometry, const struct solve_request *request,
                 struct arena *arena);

/* Makes room for what roll_back needs: as many modes in either plane. */
void roll_size(const struct roll *roll, struct body_state *sizes);

/* Turns the coordinates of a state of the scene back into the body's own planes. */
void roll_back(const struct roll *roll, struct body_state *state);

#endif
