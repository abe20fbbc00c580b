/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A beam whose section is alike in all directions may bend in any plane: the scene takes the one
 * that its contacts excite, so that a roll of the beam about its axis changes nothing. */
#ifndef PERCUSS_SOLVE_ROLL_H
#define PERCUSS_SOLVE_ROLL_H

#include "solve/problem.h"

/* Chooses the planes of every body after its contacts are placed: the loads are turned into them,
 * and so are the states (problem->rolls, problem->states). False: out of memory. */
bool roll_choose(struct problem *problem);

/* Makes room for what roll_back needs: as many modes in either plane. */
void roll_size(const struct roll *roll, struct body_state *sizes);

/* Turns the coordinates of a state of the scene back into the body's own planes. */
void roll_back(const struct roll *roll, struct body_state *state);

#endif
